#pragma once
// Which call is to fail, from the environment.
//
//     FACET_FAULT=NAME:N[:HOW]   the N-th call of NAME, from 1, fails; HOW depends on NAME
//     FACET_FAULT_COUNTS=FILE    at its end, the program writes how often each NAME was called
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace facet::faults {

/// Counts the calls of functions by name, and tells the one that is to fail. Allocates nothing:
/// allocations are among what it counts.
class Counter {
 public:
  constexpr explicit Counter(const char* name) : name_(name) {}

  [[nodiscard]] const char* name() const { return name_; }
  [[nodiscard]] std::uint64_t calls() const { return calls_; }

  /// Counts a call. Gives HOW (empty where nothing is said) for the one that is to fail, else null.
  const char* next() {
    const std::uint64_t number = ++calls_;
    if (is_chosen_ == unknown) choose();
    return is_chosen_ == yes && number == number_ ? how_ : nullptr;
  }

 private:
  enum Chosen : int { unknown, no, yes };

  void choose() {
    const char* fault = std::getenv("FACET_FAULT");
    const std::size_t length = std::strlen(name_);
    const bool is_chosen =
        fault != nullptr && std::strncmp(fault, name_, length) == 0 && fault[length] == ':';
    if (is_chosen) {
      char* end = nullptr;
      number_ = std::strtoull(fault + length + 1, &end, 10);
      how_ = *end == ':' ? end + 1 : "";
    }
    is_chosen_ = is_chosen ? yes : no;
  }

  const char* name_;
  std::atomic<std::uint64_t> calls_{0};
  std::atomic<int> is_chosen_{unknown};
  std::uint64_t number_ = 0;
  const char* how_ = "";
};

/// Adds the counts to the file that the environment names.
template <typename Counters>
void write_counts(const Counters& counters) {
  const char* file = std::getenv("FACET_FAULT_COUNTS");
  if (file == nullptr) return;
  std::FILE* out = std::fopen(file, "a");
  if (out == nullptr) return;
  for (const Counter& counter : counters)
    std::fprintf(out, "%s %llu\n", counter.name(),
                 static_cast<unsigned long long>(counter.calls()));
  std::fclose(out);
}

}  // namespace facet::faults
