#pragma once
// Functions in many more digits than float has.
#include <boost/multiprecision/mpfr.hpp>

namespace facet::extremes {

/// 160 bits, by MPFR: its functions are compiled already, which those of headers alone would take a
/// minute for.
using Exact = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<48, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

}  // namespace facet::extremes
