#include <facet/film.h>

#include <algorithm>

namespace facet {

Image::Image(int width, int height, std::vector<std::string> channels)
    : window{0, 0, width, height},
      width_(width),
      height_(height),
      channels_(std::move(channels)),
      data_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels_.size()) {
}

int Image::find_channel(const std::string& name) const {
  const auto found = std::find(channels_.begin(), channels_.end(), name);
  return found == channels_.end() ? -1 : static_cast<int>(found - channels_.begin());
}

}  // namespace facet
