#include <facet/images.h>

#include "compare/flip.h"
#include "compare/metrics.h"
#include "convergence/error_estimate.h"
#include "core/error.h"
#include "image/files.h"
#include "parts/merge.h"
#include "parts/part.h"

namespace facet {

void write_image(const std::filesystem::path& path, const Image& image,
                 const WriteOptions& options) {
  if (output_format(path) == ImageFormat::exr) {
    write_exr(path, image, options.compression);
  } else {
    write_png(path, image, options.exposure);
  }
}

void write_image(const std::filesystem::path& path, const Film& film, const WriteOptions& options) {
  const Image image =
      options.part ? make_part(film, options.variance) : develop(film, options.variance);
  write_image(path, options.error ? with_errors(image, standard_errors(film)) : image, options);
}

Film merge_parts(const std::vector<std::string>& files) {
  const PartSet set = open_parts(files);
  check_whole(set, std::nullopt, false);
  return merge(set);
}

ComparisonSummary compare(const Image& image, const Image& reference) {
  check_comparable(image, "the image", reference, "the reference");
  const ErrorMetrics errors = measure_errors(image, reference, 0);
  ComparisonSummary summary;
  summary.mean_ratio = errors.mean_ratio();
  summary.max_abs = errors.max_abs;
  summary.rmse = errors.rmse;
  summary.relmse = errors.relmse;
  summary.flip = flip(image, reference, default_pixels_per_degree).mean;
  summary.hdr_flip = hdr_flip(image, reference, default_pixels_per_degree).mean;
  summary.identical = errors.share(errors.identical);
  summary.nonfinite = errors.nonfinite;
  return summary;
}

}  // namespace facet
