#include "door/film_tree.h"

#include <algorithm>

#include "image/film.h"

namespace facet {

namespace {

/// Adds a film of the same pixels, with the samples of its record and its probes.
void join(Film& film, const Film& more) {
  add_samples(film, more);
  film.record.samples.add(more.record.samples);
  const bool same_probes =
      std::ranges::equal(film.probes, more.probes, {}, &Probe::pixel, &Probe::pixel);
  if (!same_probes) film.probes.clear();
  for (std::size_t i = 0; i < film.probes.size(); ++i)
    add_sums(film.probes[i].sums, more.probes[i].sums);
}

}  // namespace

void FilmTree::add(std::uint32_t share, Film film) {
  std::uint32_t count = 1;
  for (;;) {
    const bool is_first = share / count % 2 == 0;
    const auto neighbour = films_.find(is_first ? share + count : share - count);
    if (neighbour == films_.end() || neighbour->second.first != count) break;
    Film other = std::move(neighbour->second.second);
    films_.erase(neighbour);
    if (!is_first) {
      share -= count;
      std::swap(film, other);
    }
    join(film, other);
    count *= 2;
  }
  films_.emplace(share, std::pair(count, std::move(film)));
}

std::optional<Film> FilmTree::sum() const {
  std::optional<Film> sum;
  for (const auto& [share, film] : films_) {
    if (sum) {
      join(*sum, film.second);
    } else {
      sum = film.second;
    }
  }
  return sum;
}

}  // namespace facet
