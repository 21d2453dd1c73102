#include "cli/array_jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "image/division.h"

namespace facet::cli {

namespace {

/// Variables by which an engine tells the processes of a job apart, where it has such.
struct Engine {
  const char* name;
  const char* index;
  int base;                     ///< index of the first process
  const char* count = nullptr;  ///< of processes
  const char* first = nullptr;  ///< index of this job's first process, `base` where it is whole
  const char* last = nullptr;   ///< index of this job's last process
  const char* step = nullptr;   ///< between indices
};

// From the engines' manuals.
constexpr std::array engines{
    Engine{"slurm", "SLURM_ARRAY_TASK_ID", 1, "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN",
           "SLURM_ARRAY_TASK_MAX"},
    Engine{"srun", "SLURM_PROCID", 0, "SLURM_NTASKS"},
    Engine{"openmpi", "OMPI_COMM_WORLD_RANK", 0, "OMPI_COMM_WORLD_SIZE"},
    Engine{"mpich", "PMI_RANK", 0, "PMI_SIZE"},
    Engine{"sge", "SGE_TASK_ID", 1, nullptr, "SGE_TASK_FIRST", "SGE_TASK_LAST",
           "SGE_TASK_STEPSIZE"},
    Engine{"lsf", "LSB_JOBINDEX", 1},
    Engine{"pbs", "PBS_ARRAY_INDEX", 1},
    Engine{"aws", "AWS_BATCH_JOB_ARRAY_INDEX", 0, "AWS_BATCH_JOB_ARRAY_SIZE"},
    Engine{"google", "BATCH_TASK_INDEX", 0, "BATCH_TASK_COUNT"},
    Engine{"kubernetes", "JOB_COMPLETION_INDEX", 0},
};

/// The number that a variable holds.
long long number_of(const char* variable, const std::string& asked) {
  const char* text = std::getenv(variable);
  if (text == nullptr)
    throw InputError(
        fmt::format("{}: {} is not set, so this is no process of such a job", asked, variable));
  const auto number = parse_integer(text);
  if (!number || *number < 0 || *number > std::numeric_limits<int>::max())
    throw InputError(fmt::format("{}: {} is \"{}\", a number expected", asked, variable, text));
  return *number;
}

/// How many processes the environment speaks of. Throws InputError where it may speak of some of a
/// larger job: the same indices would be other shares.
long long count_in(const Engine& engine, const std::string& asked) {
  const char* last = engine.last == nullptr ? engine.count : engine.last;
  if (last == nullptr)
    throw InputError(
        fmt::format("{}: the environment does not tell how many there are: {}/N", asked, asked));
  const long long count =
      engine.last == nullptr ? number_of(last, asked) : number_of(last, asked) - engine.base + 1;
  const bool whole = (engine.step == nullptr || number_of(engine.step, asked) == 1) &&
                     (engine.first == nullptr || number_of(engine.first, asked) == engine.base) &&
                     (engine.count == nullptr || number_of(engine.count, asked) == count);
  if (!whole)
    throw InputError(
        fmt::format("{}: this job's indices are not {} to N; to render some of N again: {}/N",
                    asked, engine.base, asked));
  return count;
}

}  // namespace

std::string engine_names() {
  std::vector<std::string_view> names;
  names.reserve(engines.size());
  for (const Engine& engine : engines) names.emplace_back(engine.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

Share read_share(const std::string& text, const char* option) {
  if (const auto share = parse_share(text)) return *share;
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string name = text.substr(0, slash);
  const auto engine =
      std::find_if(engines.begin(), engines.end(), [&](const Engine& e) { return e.name == name; });
  if (engine == engines.end())
    throw InputError(fmt::format("{} \"{}\": I/N, I from 1 to N, or an engine expected: {}", option,
                                 text, engine_names()));
  const std::string asked = fmt::format("{} {}", option, name);
  const long long index = number_of(engine->index, asked) - engine->base + 1;
  const auto given = slash < text.size() ? parse_integer(text.substr(slash + 1)) : std::nullopt;
  if (slash < text.size() && (!given || *given < 1 || *given > largest_sample_count))
    throw InputError(fmt::format("{} \"{}\": {}/N expected", option, text, name));
  const long long count = given ? *given : count_in(*engine, asked);
  if (index < 1 || index > count)
    throw InputError(fmt::format("{}: {} is {}, but {} to {} expected", asked, engine->index,
                                 index + engine->base - 1, engine->base, count + engine->base - 1));
  return {static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(count)};
}

}  // namespace facet::cli
