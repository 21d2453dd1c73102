#pragma once
// The BSDFs' parameters: one type for each line of the shared list.
#include <array>
#include <string_view>
#include <variant>

#include "generated/scene_bsdfs.h"
#include "shared/bsdf_list.h"

namespace facet {

namespace detail {
/// Turns the list, which ends every entry alike, into a variant's arguments.
template <typename First, typename... Types>
std::variant<Types...> variant_without_first(std::variant<First, Types...>);
}  // namespace detail

/// Any BSDF; the alternative's index is the id of the shared list.
using Bsdf = decltype(detail::variant_without_first(std::variant<std::monostate
#define FACET_TYPE(name, Type, id) , bsdf::Type
                                                                     FACET_BSDF_LIST(FACET_TYPE)
#undef FACET_TYPE
                                                                 >{}));

#define FACET_CHECK(name, Type, id)                                               \
  static_assert(std::is_same_v<std::variant_alternative_t<id, Bsdf>, bsdf::Type>, \
                "ids count up from 0");
FACET_BSDF_LIST(FACET_CHECK)
#undef FACET_CHECK

/// The scene language's names, by id.
inline constexpr std::array bsdf_type_names{
#define FACET_NAME(name, Type, id) std::string_view(#name),
    FACET_BSDF_LIST(FACET_NAME)
#undef FACET_NAME
};

}  // namespace facet
