#pragma once
// Renders divided into shares: which samples and pixels a share holds, and how it is called.
#include <facet/film.h>

#include <string>
#include <string_view>

namespace facet {

/// Most samples of a pixel, and largest number of one.
inline constexpr std::uint32_t largest_sample_count = 1U << 30U;

/// Most shares of a render, parts times tiles.
inline constexpr std::uint64_t most_shares = 1U << 20U;

/// A part of the samples of a tile.
struct TileShare {
  Share part;
  Share tile;
};

/// The samples of a share, perhaps none.
[[nodiscard]] SampleRange share_of(const SampleRange& whole, const Share& part);
/// The pixels of a share of the rows, perhaps none.
[[nodiscard]] Crop share_of(const Crop& whole, const Share& tile);

/// The share that holds just these samples of these pixels, if one does.
[[nodiscard]] std::optional<TileShare> find_share(const Division& division,
                                                  const SampleRange& samples, const Crop& pixels);

/// The options of `facet render` that ask for a share of a division of an image, each behind a
/// blank; where there is one tile, or one part, nothing of tiles or parts.
[[nodiscard]] std::string share_options(const Division& division, const TileShare& share,
                                        const ImageSize& size);

/// Those that ask for all shares together.
[[nodiscard]] std::string whole_options(const Division& division, const ImageSize& size);

/// Whether all of the pixels are among others.
[[nodiscard]] bool is_within(const Crop& pixels, const Crop& others);

/// Number of pixels.
[[nodiscard]] long long area(const Crop& pixels);

/// "0,0,640,480", as --crop reads it.
[[nodiscard]] std::string crop_text(const Crop& pixels);

/// As parse_division reads it: "16 parts of 0:64, 4 tiles of 0,0,640,480".
[[nodiscard]] std::string division_text(const Division& division);
/// Nothing for a text that division_text cannot have written, or shares of which some are empty.
[[nodiscard]] std::optional<Division> parse_division(const std::string& text);

/// "3/16"; nothing for another text, or an index that is not from 1 to the count.
[[nodiscard]] std::optional<Share> parse_share(std::string_view text);

/// A share's file by the name of the whole one, so that all sort in order:
/// "cbox_tile_2_of_4_part_03_of_16.exr".
[[nodiscard]] std::string share_file(const std::string& stem, const std::optional<Share>& part,
                                     const std::optional<Share>& tile);

}  // namespace facet
