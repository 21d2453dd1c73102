// `facet render --part ENGINE`: the environment of an array job tells which share.
#include "cli/merge.h"

namespace facet::test {

namespace {

class ArrayJobsCliTest : public MergeCliTest {
 protected:
  [[nodiscard]] Result render_as(const std::string& part,
                                 const std::vector<std::string>& variables) const {
    return run({"render", "scene.xml", "--spp", "8", "-o", "a.exr", "--quiet", "--part", part},
               variables);
  }
  void expect_samples(const std::string& part, const std::vector<std::string>& variables,
                      const std::string& samples) const {
    const Result result = render_as(part, variables);
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(metadata(read("a.exr"), "facet.samples"), samples) << part;
  }
  void refused(const std::string& part, const std::vector<std::string>& variables,
               std::initializer_list<const char*> words) const {
    const Result result = render_as(part, variables);
    EXPECT_EQ(result.code, 2) << part;
    expect_words(result.err, words);
  }

  const std::vector<std::string> slurm_{"SLURM_ARRAY_TASK_ID=3", "SLURM_ARRAY_TASK_MIN=1",
                                        "SLURM_ARRAY_TASK_MAX=4", "SLURM_ARRAY_TASK_COUNT=4"};
};

TEST_F(ArrayJobsCliTest, EnginesTellWhichShare) {
  expect_samples("slurm", slurm_, "4:6");
  expect_samples("slurm/8", slurm_, "2:3");
  expect_samples("sge",
                 {"SGE_TASK_ID=4", "SGE_TASK_FIRST=1", "SGE_TASK_LAST=4", "SGE_TASK_STEPSIZE=1"},
                 "6:8");
  expect_samples("aws", {"AWS_BATCH_JOB_ARRAY_INDEX=0", "AWS_BATCH_JOB_ARRAY_SIZE=2"}, "0:4");
  expect_samples("google", {"BATCH_TASK_INDEX=1", "BATCH_TASK_COUNT=2"}, "4:8");
  expect_samples("srun", {"SLURM_PROCID=1", "SLURM_NTASKS=2"}, "4:8");
  expect_samples("openmpi", {"OMPI_COMM_WORLD_RANK=1", "OMPI_COMM_WORLD_SIZE=4"}, "2:4");
  expect_samples("mpich", {"PMI_RANK=1", "PMI_SIZE=4"}, "2:4");
  expect_samples("kubernetes/4", {"JOB_COMPLETION_INDEX=3"}, "6:8");
  expect_samples("pbs/4", {"PBS_ARRAY_INDEX=4"}, "6:8");
  expect_samples("lsf/4", {"LSB_JOBINDEX=1"}, "0:2");
}

TEST_F(ArrayJobsCliTest, WhatDoesNotTellIsRefused) {
  refused("slurm", {}, {"--part slurm", "SLURM_ARRAY_TASK_ID is not set"});
  refused("slurm/4", {"SLURM_ARRAY_TASK_ID=0"}, {"SLURM_ARRAY_TASK_ID is 0, but 1 to 4"});
  refused("slurm/4", {"SLURM_ARRAY_TASK_ID=5"}, {"SLURM_ARRAY_TASK_ID is 5, but 1 to 4"});
  refused("slurm/0", slurm_, {"slurm/N expected"});
  // Some of an array once more: the same index would be another share.
  refused("slurm",
          {"SLURM_ARRAY_TASK_ID=3", "SLURM_ARRAY_TASK_MIN=3", "SLURM_ARRAY_TASK_MAX=4",
           "SLURM_ARRAY_TASK_COUNT=2"},
          {"not 1 to N", "slurm/N"});
  refused("slurm",
          {"SLURM_ARRAY_TASK_ID=1", "SLURM_ARRAY_TASK_MIN=1", "SLURM_ARRAY_TASK_MAX=4",
           "SLURM_ARRAY_TASK_COUNT=2"},
          {"not 1 to N", "slurm/N"});
  refused("kubernetes", {"JOB_COMPLETION_INDEX=3"}, {"how many", "kubernetes/N"});
  refused("aws/2", {"AWS_BATCH_JOB_ARRAY_INDEX=2"}, {"is 2, but 0 to 1"});
  refused("sge", {"SGE_TASK_ID=3", "SGE_TASK_FIRST=1", "SGE_TASK_LAST=3", "SGE_TASK_STEPSIZE=2"},
          {"not 1 to N"});
  refused("sge", {"SGE_TASK_ID=undefined"}, {"SGE_TASK_ID is \"undefined\""});
}

}  // namespace

}  // namespace facet::test
