#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include "core/error.h"
#include "core/parallel.h"
#include "image/atomic_file.h"
#include "image/files.h"

namespace facet {

namespace {

Imf::Slice slice_of(const float* plane, const Imath::Box2i& window) {
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x) + 1;
  const auto offset =
      static_cast<std::ptrdiff_t>(window.min.y) * static_cast<std::ptrdiff_t>(width) + window.min.x;
  // OpenEXR addresses pixels from the origin of the display window and takes its buffers without const.
  auto* base =
      reinterpret_cast<char*>(const_cast<float*>(plane) - offset);  // NOLINT(*-const-cast,*-reinterpret-cast)
  return {Imf::FLOAT, base, sizeof(float), sizeof(float) * width};
}

Image read_exr_file(const std::filesystem::path& path) {
  Imf::InputFile file(path.c_str(), static_cast<int>(thread_count()));
  const Imath::Box2i window = file.header().dataWindow();
  const long long width = 1LL + window.max.x - window.min.x;
  const long long height = 1LL + window.max.y - window.min.y;
  check_file_image_size(path, width, height);
  std::vector<std::string> channels;
  for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c)
    channels.emplace_back(c.name());
  Image image(static_cast<int>(width), static_cast<int>(height), channels);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    buffer.insert(channels[c], slice_of(image.plane(static_cast<int>(c)), window));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  const Imath::Box2i display = file.header().displayWindow();
  image.window = {window.min.x - display.min.x, window.min.y - display.min.y,
                  display.max.x - display.min.x + 1, display.max.y - display.min.y + 1};
  for (auto a = file.header().begin(); a != file.header().end(); ++a) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
    if (text != nullptr) image.metadata.emplace_back(a.name(), text->value());
  }
  return image;
}

}  // namespace

Image read_exr(const std::filesystem::path& path) {
  check_readable(path);
  try {
    return read_exr_file(path);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError(fmt::format("{}: not a readable EXR image: {}", path.string(), e.what()));
  }
}

void write_exr(const std::filesystem::path& path, const Image& image) {
  const Imath::V2i origin(image.window.x, image.window.y);
  const Imath::Box2i data(origin, origin + Imath::V2i(image.width() - 1, image.height() - 1));
  const Imath::Box2i display(Imath::V2i(0, 0),
                             Imath::V2i(image.window.full_width - 1, image.window.full_height - 1));
  Imf::Header header(display, data, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
  for (const auto& [name, text] : image.metadata) header.insert(name.c_str(), Imf::StringAttribute(text));
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < image.channels().size(); ++c) {
    header.channels().insert(image.channels()[c], Imf::Channel(Imf::FLOAT));
    buffer.insert(image.channels()[c], slice_of(image.plane(static_cast<int>(c)), data));
  }
  AtomicFile file(path);
  try {
    Imf::OutputFile out(file.temporary().c_str(), header, static_cast<int>(thread_count()));
    out.setFrameBuffer(buffer);
    out.writePixels(image.height());
  } catch (const std::exception& e) {
    throw InputError(fmt::format("{}: cannot write: {}", path.string(), e.what()));
  }
  file.commit();
}

}  // namespace facet
