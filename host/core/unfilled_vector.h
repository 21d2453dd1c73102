#pragma once
// Vectors of very many elements, which whoever fills them touches first: on all cores, where making
// them would do it on one.
#include <memory>
#include <utility>
#include <vector>

namespace facet {

/// Leaves elements of trivial types uninitialised where no value is given.
template <typename T>
class UnfilledAllocator : public std::allocator<T> {
 public:
  template <typename U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
};

template <typename T>
using UnfilledVector = std::vector<T, UnfilledAllocator<T>>;

}  // namespace facet
