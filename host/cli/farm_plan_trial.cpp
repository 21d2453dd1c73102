#include "cli/farm_plan_trial.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/clock.h"
#include "core/error.h"
#include "image/files.h"
#include "parts/part.h"
#include "parts/part_file.h"

namespace facet::cli {

namespace {

/// A folder of this process alone, which goes with this.
class TrialFolder {
 public:
  TrialFolder() : path_((std::filesystem::temp_directory_path() / "facet-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr)
      throw InputError(fmt::format("{}: cannot be made: {}", path_, std::strerror(errno)));
  }
  ~TrialFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;

  [[nodiscard]] std::string file() const { return path_ + "/part.exr"; }

 private:
  std::string path_;
};

}  // namespace

void measure_part(Film film, ExrCompression compression, tradeoff::FarmMeasurement& measured) {
  film.record.stopped_by = StoppedBy::samples;
  const TrialFolder folder;
  Clock::time_point start = Clock::now();
  write_exr(folder.file(), make_part(film, film.has_squares), compression);
  measured.start_seconds += seconds_since(start);
  measured.part_bytes = static_cast<double>(std::filesystem::file_size(folder.file()));
  start = Clock::now();
  (void)open_part(folder.file()).read();
  measured.merge_seconds = seconds_since(start);
}

}  // namespace facet::cli
