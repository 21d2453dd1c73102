#pragma once
// Films of the shares of a render, added in an order that does not depend on when they come.
#include <facet/film.h>

#include <map>
#include <utility>

namespace facet {

/// A binary tree over shares, a power of two of them: two neighbours are added when both are there,
/// then their sums, and so on. As few films are kept as gaps between them allow.
class FilmTree {
 public:
  /// The film of a share, each once; of the same pixels as the others.
  void add(std::uint32_t share, Film film);

  /// The sum of all there are, without any meaning to its record but for its samples; nothing
  /// without any.
  [[nodiscard]] std::optional<Film> sum() const;

 private:
  /// By first share, with how many shares they are of.
  std::map<std::uint32_t, std::pair<std::uint32_t, Film>> films_;
};

}  // namespace facet
