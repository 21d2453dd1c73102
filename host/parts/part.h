#pragma once
// Parts: images that carry the sums they were made from, so that they can be joined without loss.
#include <facet/film.h>

#include "image/record.h"
#include "image/render_state.h"

namespace facet {

/// A channel of words, whose name begins with word_prefix.
struct WordChannel {
  std::string name;
  const WordPlane* words;  ///< one a pixel
};

/// Develops the film like develop(), and adds its sums as channels, each as an unevaluated pair of
/// floats: `sum.R` + `sum.R.low` and so on, `square.R` + `square.R.low` and so on where the film
/// has squares, and `samples` + `samples.low`, `samples.nonzero` + `samples.nonzero.low`. Counts
/// are exact.
///
/// Sums are stored divided by 2^facet.sumExponent, squares by 2^facet.squareExponent (metadata): 0
/// while all values lie within 2^-100 ... 2^126, else as puts the largest just below 2^127. What is
/// stored is then within 2^-49 of the sum, relatively, for every value above 2^-227 of the film's
/// largest, and within 2^-276 of that largest below. Infinities and NaN stay what they are. R, G, B
/// and the variance are developed from the sums as stored. `words` and `metadata` are added, and a
/// checksum of all (parts/checksum.h).
[[nodiscard]] Image make_part(const Film& film, bool with_variance,
                              const std::vector<WordChannel>& words = {},
                              const Metadata& metadata = {});

/// The film of a part, its window included. Throws InputError, which begins with the name, for an
/// image that lacks such channels or metadata, or whose numbers contradict each other: counts that
/// are no counts, exceed most_samples or each other, or a mean that is not that of its sum.
[[nodiscard]] Film film_of_part(const Image& image, std::uint32_t most_samples,
                                const std::string& name);

}  // namespace facet
