#pragma once
// The film on a device: in pieces, as large as its storage buffers may be.
#include "image/film.h"
#include "image/render_state.h"
#include "render/bindings.h"

namespace facet {

/// A contiguous part of the film.
struct FilmPiece {
  std::uint32_t first_pixel = 0;
  std::uint32_t pixel_count = 0;
};

class FilmBuffers {
 public:
  /// A black film. with_squares: for the variance.
  FilmBuffers(gpu::Device& device, std::uint32_t pixel_count, bool with_squares);

  void add_to(gpu::BufferMap& map, std::size_t piece) const;
  [[nodiscard]] const std::vector<FilmPiece>& pieces() const { return pieces_; }
  [[nodiscard]] std::uint32_t pixel_count() const { return pixel_count_; }
  /// (first pixel, count) of a piece's passes: whole workgroups of even sizes, at most `most`
  /// pixels each.
  [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> pixel_ranges(
      std::size_t piece, std::uint32_t most) const;

  /// Black again.
  void clear();

  /// Adds the sums to a film of as many pixels, which has squares where this has. square_scale:
  /// factor on the values that have been squared.
  void read(Film& film, float square_scale) const;

  /// The records as they are: a plane for each word of them, those of squares last.
  [[nodiscard]] std::vector<WordPlane> words() const;
  /// Sets them. Throws std::invalid_argument unless there are as many.
  void set_words(const std::vector<WordPlane>& planes);

 private:
  std::uint32_t pixel_count_;
  bool with_squares_;
  std::vector<FilmPiece> pieces_;
  std::vector<gpu::Buffer> sums_;     ///< one a piece
  std::vector<gpu::Buffer> squares_;  ///< likewise; dummies without squares
};

}  // namespace facet
