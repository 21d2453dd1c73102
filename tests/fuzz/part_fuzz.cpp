// Parts and checkpoints: merged, told about, and continued.
#include "convergence/sampling_plan.h"
#include "fuzz/target.h"
#include "parts/checkpoint.h"
#include "parts/merge.h"

namespace {

/// A state that is not refused is one that a plan takes, or says that it cannot be.
void restore(const facet::RenderState& state) {
  using namespace facet;
  SamplingGoal goal;
  goal.width = state.film.width;
  goal.height = state.film.height;
  goal.samples = {state.first, state.first + state.most};
  goal.adaptive = state.film.record.adaptive;
  goal.probes = state.probes;
  goal.error = state.error;
  try {
    SamplingPlan(goal).restore(state.plan);
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facet;
  const std::string file = fuzz::workplace().write("part.exr", fuzz::text_of(data, size)).string();
  fuzz::expect_input_errors([&] { (void)merge(open_parts({file})); });
  fuzz::expect_input_errors([&] { restore(read_checkpoint(file)); });
  fuzz::expect_input_errors([&] {
    const PartFile part{file, read_exr_header(file), {}};
    if (is_checkpoint(part.header)) (void)(describe_progress(part) + continue_command(part));
  });
  return 0;
}
