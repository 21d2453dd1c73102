// synthetic_parts FOLDER COUNT WIDTH HEIGHT BITS zip|none: as many part files as a farm would
// write, without rendering: each says that it is another share of one render, and all hold the same
// pixels, random numbers of so many bits a channel (24: as hard to compress as those of a render).
// The merged image is what any of them shows.
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "image/division.h"
#include "image/files.h"
#include "image/film.h"
#include "image/record.h"
#include "parts/checksum.h"
#include "parts/part.h"

namespace {

using namespace facet;

constexpr std::uint32_t samples_of_a_part = 4;

Film random_film(int width, int height, int bits) {
  Film film = make_film(width, height, {0, 0, width, height}, false);
  std::mt19937 random(1);
  const double steps = std::ldexp(1, bits);
  for (PixelSums& pixel : film.pixels) {
    // A sum of few samples has a few bits more than they have.
    for (double& sum : pixel.values)
      sum = samples_of_a_part * std::floor(static_cast<double>(random()) * 0x1p-32 * steps) / steps;
    pixel.samples = samples_of_a_part;
    pixel.nonzero = samples_of_a_part;
  }
  return film;
}

RenderRecord record_of(const Share& part, const Film& film) {
  RenderRecord record;
  record.version = "0";
  record.scene = "synthetic.xml";
  record.integrator = "path_mis";
  record.sampler = "independent";
  record.filter = "box";
  record.backend = "vulkan";
  record.device = "none";
  record.driver = "none";
  record.division =
      Division{{0, samples_of_a_part * part.count}, part.count, {0, 0, film.width, film.height}, 1};
  record.samples.add(share_of(record.division->samples, part));
  return record;
}

/// The first part with another header: its pixels stay packed as they are.
void write_copy(const std::filesystem::path& first, Image& image, const RenderRecord& record,
                const std::filesystem::path& path) {
  Imf::InputFile in(first.c_str());
  Imf::Header header = in.header();
  for (const auto& [key, text] : header_of(record)) {
    for (auto& entry : image.metadata) {
      if (entry.first == key) entry.second = text;
    }
  }
  add_checksum(image);
  for (const auto& [key, text] : image.metadata)
    header.insert(key.c_str(), Imf::StringAttribute(text));
  Imf::OutputFile out(path.c_str(), header);
  out.copyPixels(in);
}

int run(const std::filesystem::path& folder, std::uint32_t count, int width, int height, int bits,
        ExrCompression compression) {
  Film film = random_film(width, height, bits);
  film.record = record_of({1, count}, film);
  Image image = make_part(film, false);
  const auto file = [&](std::uint32_t i) {
    return folder / share_file("synthetic", Share{i, count}, std::nullopt);
  };
  write_exr(file(1), image, compression);
  for (std::uint32_t i = 2; i <= count; ++i)
    write_copy(file(1), image, record_of({i, count}, film), file(i));
  fmt::print("{} parts of {} bytes\n", count, std::filesystem::file_size(file(1)));
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 7) {
    fmt::print(stderr, "usage: {} FOLDER COUNT WIDTH HEIGHT BITS zip|none\n", argv[0]);
    return EXIT_FAILURE;
  }
  try {
    return run(
        argv[1], static_cast<std::uint32_t>(std::atoi(argv[2])), std::atoi(argv[3]),
        std::atoi(argv[4]), std::atoi(argv[5]),
        std::string_view(argv[6]) == "none" ? ExrCompression::uncompressed : ExrCompression::zip);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return EXIT_FAILURE;
  }
}
