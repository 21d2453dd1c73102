#pragma once
// Progress on standard error: a bar on a terminal, plain lines otherwise.
#include <facet/request.h>

#include <chrono>

namespace facet::cli {

class Progress {
 public:
  /// error_estimate: called rarely, for the bar; may be empty.
  Progress(bool quiet, std::function<double()> error_estimate);

  void update(double done, const RenderStatistics& statistics);
  /// Ends the bar.
  void finish();

 private:
  void draw_bar(double done, const RenderStatistics& statistics);
  void print_line(double done, const RenderStatistics& statistics);

  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  std::function<double()> error_estimate_;
  double error_ = 0;
  double next_error_ = 0.5;  ///< seconds of rendering at which the error is estimated again
  double next_line_ = 2;     ///< likewise for the next plain line
  std::chrono::steady_clock::time_point last_;
};

}  // namespace facet::cli
