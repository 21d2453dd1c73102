#pragma once
// Functions in many more digits than float has.
#include <boost/multiprecision/mpfr.hpp>

namespace facet::extremes {

/// 160 bits, by MPFR: its functions are compiled already, which those of headers alone would take a
/// minute for.
using Exact = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<48, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

/// To be made by every thread that computes with these and ends: MPFR keeps constants for each.
class ExactThread {
 public:
  ExactThread() = default;
  ~ExactThread() { mpfr_free_cache(); }
  ExactThread(const ExactThread&) = delete;
  ExactThread& operator=(const ExactThread&) = delete;
};

}  // namespace facet::extremes
