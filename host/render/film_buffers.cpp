#include "render/film_buffers.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/error.h"
#include "core/text.h"

namespace facet {

namespace {

/// The sums that a record keeps as hi + lo.
std::array<double, 3> whole_sums(const shared::FilmRecord& r) {
  return {static_cast<double>(r.hi_r) + r.lo_r, static_cast<double>(r.hi_g) + r.lo_g,
          static_cast<double>(r.hi_b) + r.lo_b};
}

constexpr std::size_t record_words = sizeof(shared::FilmRecord) / sizeof(std::uint32_t);
using RecordWords = std::array<std::uint32_t, record_words>;

}  // namespace

FilmBuffers::FilmBuffers(gpu::Device& device, std::uint32_t pixel_count, bool with_squares)
    : pixel_count_(pixel_count), with_squares_(with_squares) {
  constexpr std::uint64_t record = sizeof(shared::FilmRecord);
  const std::uint64_t record_set = with_squares ? 2 * record : record;
  const std::uint64_t fitting = device.free_bytes() / record_set;
  if (pixel_count * record_set > device.free_bytes())
    throw InputError(fmt::format(
        "the film of {} pixels needs {}B of device memory, but of the {}B of {} {}B are free: "
        "about {} pixels fit at a time (--crop renders part of an image)",
        pixel_count, with_unit_prefix(static_cast<double>(pixel_count * record_set)),
        with_unit_prefix(static_cast<double>(device.info().memory_bytes)), device.info().name,
        with_unit_prefix(static_cast<double>(device.free_bytes())),
        with_unit_prefix(static_cast<double>(fitting))));
  const gpu::Device::Limits& limits = device.limits();
  const auto largest = static_cast<std::uint32_t>(
      std::min(limits.storage_buffer_bytes / record,
               limits.texel_buffer_texels * sizeof(glm::uvec4) / record));
  for (std::uint32_t first = 0; first < pixel_count;) {
    const std::uint32_t count = std::min(largest, pixel_count - first);
    pieces_.push_back({first, count});
    sums_.emplace_back(device, count * record, "the film").clear();
    squares_.emplace_back(device, with_squares ? count * record : 0, "the film's variance").clear();
    first += count;
  }
}

void FilmBuffers::clear() {
  for (gpu::Buffer& sums : sums_) sums.clear();
  for (gpu::Buffer& squares : squares_) squares.clear();
}

void FilmBuffers::add_to(gpu::BufferMap& map, std::size_t piece) const {
  map[shared::BINDING_film] = &sums_[piece];
  map[shared::BINDING_film_squares] = &squares_[piece];
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> FilmBuffers::pixel_ranges(
    std::size_t piece, std::uint32_t most) const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges;
  const auto [begin, pixels] = pieces_[piece];
  const std::uint32_t passes = (pixels + most - 1) / most;
  const std::uint32_t even = (pixels + passes - 1) / passes;
  const std::uint32_t size = std::min(most, workgroups(even) * shared::WORKGROUP_SIZE);
  for (std::uint32_t first = begin; first < begin + pixels;) {
    const std::uint32_t count = std::min(size, begin + pixels - first);
    ranges.emplace_back(first, count);
    first += count;
  }
  return ranges;
}

void FilmBuffers::read(Film& film, float square_scale) const {
  const double unscale = 1 / (static_cast<double>(square_scale) * square_scale);
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const auto [first, count] = pieces_[p];
    const auto sums = sums_[p].download<shared::FilmRecord>(count);
    const auto squares = squares_[p].download<shared::FilmRecord>(with_squares_ ? count : 0);
    for (std::uint32_t i = 0; i < count; ++i) {
      PixelSums& pixel = film.pixels[first + i];
      pixel.values = whole_sums(sums[i]);
      pixel.samples = sums[i].samples;
      pixel.nonzero = sums[i].nonzero;
      if (!with_squares_) continue;
      pixel.squares = whole_sums(squares[i]);
      for (double& s : pixel.squares) s *= unscale;
    }
  }
}

std::vector<WordPlane> FilmBuffers::words() const {
  std::vector<WordPlane> planes((with_squares_ ? 2 : 1) * record_words, WordPlane(pixel_count_));
  const auto read_planes = [&](const std::vector<gpu::Buffer>& buffers, std::size_t first_plane) {
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const auto [first, count] = pieces_[p];
      const auto records = buffers[p].download<RecordWords>(count);
      for (std::uint32_t i = 0; i < count; ++i) {
        for (std::size_t word = 0; word < record_words; ++word)
          planes[first_plane + word][first + i] = records[i][word];
      }
    }
  };
  read_planes(sums_, 0);
  if (with_squares_) read_planes(squares_, record_words);
  return planes;
}

void FilmBuffers::set_words(const std::vector<WordPlane>& planes) {
  const bool fits = planes.size() == (with_squares_ ? 2 : 1) * record_words &&
                    std::all_of(planes.begin(), planes.end(), [&](const WordPlane& plane) {
                      return plane.size() == pixel_count_;
                    });
  if (!fits) throw std::invalid_argument("words of another film");
  const auto write_planes = [&](std::vector<gpu::Buffer>& buffers, std::size_t first_plane) {
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const auto [first, count] = pieces_[p];
      std::vector<RecordWords> records(count);
      for (std::uint32_t i = 0; i < count; ++i) {
        for (std::size_t word = 0; word < record_words; ++word)
          records[i][word] = planes[first_plane + word][first + i];
      }
      buffers[p].upload(records);
    }
  };
  write_planes(sums_, 0);
  if (with_squares_) write_planes(squares_, record_words);
}

}  // namespace facet
