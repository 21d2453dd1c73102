#include "image/division.h"

#include <fmt/format.h>

#include <cstdio>

#include "core/text.h"

namespace facet {

namespace {

/// Where the things of `count` equal shares are divided, behind the first `shares` of them.
template <typename Number>
Number divided(Number begin, Number end, std::uint32_t shares, std::uint32_t count) {
  const auto length = static_cast<std::uint64_t>(end - begin);
  return begin + static_cast<Number>(length * shares / count);
}

bool has_all_shares(const Division& d) {
  const Crop& p = d.pixels;
  return d.samples.begin < d.samples.end && d.samples.end <= largest_sample_count && d.parts >= 1 &&
         d.parts <= d.samples.end - d.samples.begin && p.x0 >= 0 && p.y0 >= 0 && p.x0 < p.x1 &&
         p.y0 < p.y1 && std::uint64_t{d.parts} * d.tiles <= most_shares && d.tiles >= 1 &&
         d.tiles <= static_cast<std::uint32_t>(p.y1 - p.y0);
}

std::string numbered(const char* what, const std::optional<Share>& share) {
  if (!share) return "";
  const auto digits = static_cast<int>(fmt::formatted_size("{}", share->count));
  return fmt::format("_{}_{:0{}}_of_{}", what, share->index, digits, share->count);
}

}  // namespace

SampleRange share_of(const SampleRange& whole, const Share& part) {
  return {divided(whole.begin, whole.end, part.index - 1, part.count),
          divided(whole.begin, whole.end, part.index, part.count)};
}

Crop share_of(const Crop& whole, const Share& tile) {
  return {whole.x0, divided(whole.y0, whole.y1, tile.index - 1, tile.count), whole.x1,
          divided(whole.y0, whole.y1, tile.index, tile.count)};
}

std::optional<TileShare> find_share(const Division& d, const SampleRange& samples,
                                    const Crop& pixels) {
  TileShare share{{1, d.parts}, {1, d.tiles}};
  while (share.part.index <= d.parts && share_of(d.samples, share.part) != samples)
    ++share.part.index;
  while (share.tile.index <= d.tiles && share_of(d.pixels, share.tile) != pixels)
    ++share.tile.index;
  if (share.part.index > d.parts || share.tile.index > d.tiles) return std::nullopt;
  return share;
}

std::string share_options(const Division& d, const TileShare& share, const ImageSize& size) {
  std::string options;
  if (d.parts > 1 || d.tiles == 1)
    options += fmt::format(" --part={}/{}", share.part.index, d.parts);
  if (d.tiles > 1) options += fmt::format(" --tile={}/{}", share.tile.index, d.tiles);
  return options + whole_options(d, size);
}

std::string whole_options(const Division& d, const ImageSize& size) {
  std::string options =
      fmt::format(" --spp={} --resolution={}x{}", d.samples.end, size.width, size.height);
  if (d.pixels != Crop{0, 0, size.width, size.height}) options += " --crop=" + crop_text(d.pixels);
  return options;
}

bool is_within(const Crop& pixels, const Crop& others) {
  return pixels.x0 >= others.x0 && pixels.y0 >= others.y0 && pixels.x1 <= others.x1 &&
         pixels.y1 <= others.y1;
}

long long area(const Crop& pixels) {
  return static_cast<long long>(pixels.x1 - pixels.x0) * (pixels.y1 - pixels.y0);
}

std::string crop_text(const Crop& pixels) {
  return fmt::format("{},{},{},{}", pixels.x0, pixels.y0, pixels.x1, pixels.y1);
}

std::string division_text(const Division& d) {
  return fmt::format("{} parts of {}:{}, {} tiles of {}", d.parts, d.samples.begin, d.samples.end,
                     d.tiles, crop_text(d.pixels));
}

std::optional<Division> parse_division(const std::string& text) {
  Division d;
  const int found =
      std::sscanf(text.c_str(), "%u parts of %u:%u, %u tiles of %d,%d,%d,%d", &d.parts,
                  &d.samples.begin, &d.samples.end, &d.tiles, &d.pixels.x0, &d.pixels.y0,
                  &d.pixels.x1, &d.pixels.y1);  // NOLINT(*-vararg,cert-err34-c)
  // Whatever was not understood as it was meant, numbers too large among it, is written otherwise.
  if (found != 8 || division_text(d) != text || !has_all_shares(d)) return std::nullopt;
  return d;
}

std::optional<Share> parse_share(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto index = parse_integer(text.substr(0, slash));
  const auto count = parse_integer(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count || *count > largest_sample_count)
    return std::nullopt;
  return Share{static_cast<std::uint32_t>(*index), static_cast<std::uint32_t>(*count)};
}

std::string share_file(const std::string& stem, const std::optional<Share>& part,
                       const std::optional<Share>& tile) {
  return stem + numbered("tile", tile) + numbered("part", part) + ".exr";
}

}  // namespace facet
