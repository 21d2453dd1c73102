#pragma once
// Functions in many more digits than float has.
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace facet::extremes {

/// 160 bits, without the expression templates that make compiling slow.
using Exact = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<160, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

}  // namespace facet::extremes
