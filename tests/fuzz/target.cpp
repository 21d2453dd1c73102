#include "fuzz/target.h"

#include <unistd.h>

#include "fuzz/seeds.h"

namespace facet::fuzz {

namespace {

std::filesystem::path make_folder() {
  const bool has_memory = ::access("/dev/shm", W_OK) == 0;
  const std::filesystem::path parent =
      has_memory ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path();
  std::string pattern = (parent / "facet-fuzz-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) std::abort();
  return pattern;
}

}  // namespace

Workplace::Workplace() : path_(make_folder()) {
  for (const Seed& seed : seeds()) {
    if (seed.companion) write(seed.name, seed.bytes);
  }
}

Workplace::~Workplace() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path Workplace::write(const std::string& name, std::string_view bytes) const {
  std::ofstream file(path_ / name, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path_ / name;
}

const Workplace& workplace() {
  static const Workplace place;
  return place;
}

}  // namespace facet::fuzz
