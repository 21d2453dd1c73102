#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
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

ExrHeader header_of(const std::filesystem::path& path, const Imf::Header& header) {
  const Imath::Box2i window = header.dataWindow();
  const long long width = 1LL + window.max.x - window.min.x;
  const long long height = 1LL + window.max.y - window.min.y;
  check_file_image_size(path, width, height);
  if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
    throw InputError(fmt::format("{}: is a cube map; latitude-longitude images are read", path.string()));
  const Imath::Box2i display = header.displayWindow();
  ExrHeader result{static_cast<int>(width),
                   static_cast<int>(height),
                   {window.min.x - display.min.x, window.min.y - display.min.y,
                    display.max.x - display.min.x + 1, display.max.y - display.min.y + 1},
                   {},
                   {}};
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    result.channels.emplace_back(c.name());
  for (auto a = header.begin(); a != header.end(); ++a) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
    if (text != nullptr) result.metadata.emplace_back(a.name(), text->value());
  }
  return result;
}

Image read_pixels(const std::filesystem::path& path, Imf::InputFile& file) {
  const ExrHeader header = header_of(path, file.header());
  Image image(header.width, header.height, header.channels);
  image.window = header.window;
  image.metadata = header.metadata;
  const Imath::Box2i window = file.header().dataWindow();
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < header.channels.size(); ++c) {
    buffer.insert(header.channels[c], slice_of(image.plane(static_cast<int>(c)), window));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

/// Opens the file and has it read; whatever goes wrong becomes an InputError that names it.
template <typename Read>
auto read_file(const std::filesystem::path& path, const Read& read) {
  check_readable(path);
  try {
    Imf::InputFile file(path.c_str(), static_cast<int>(thread_count()));
    return read(path, file);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError(fmt::format("{}: not a readable EXR image: {}", path.string(), e.what()));
  }
}

/// What OpenEXR writes goes through the file, which remembers a failure that OpenEXR's destructors swallow.
class ExrStream : public Imf::OStream {
 public:
  ExrStream(AtomicFile& file, const std::filesystem::path& path) : OStream(path.c_str()), file_(file) {}

  void write(const char* data, int size) override { file_.write(data, static_cast<std::size_t>(size)); }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override { file_.seek(position); }

 private:
  AtomicFile& file_;
};

}  // namespace

Image read_exr(const std::filesystem::path& path) { return read_file(path, read_pixels); }

ExrHeader read_exr_header(const std::filesystem::path& path) {
  return read_file(path, [](const std::filesystem::path& name, const Imf::InputFile& file) {
    return header_of(name, file.header());
  });
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
    ExrStream stream(file, path);
    Imf::OutputFile out(stream, header, static_cast<int>(thread_count()));
    out.setFrameBuffer(buffer);
    out.writePixels(image.height());
  } catch (const std::exception& e) {
    // The file knows best why.
    file.check();
    throw InputError(fmt::format("{}: cannot write: {}", path.string(), e.what()));
  }
  file.commit();
}

}  // namespace facet
