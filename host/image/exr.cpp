#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/input_file.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "image/exr_attributes.h"
#include "image/files.h"
#include "image/plain_exr.h"

namespace facet {

namespace {

Imf::PixelType type_of(const std::string& channel) {
  return channel.starts_with(word_prefix) ? Imf::UINT : Imf::FLOAT;
}

Imf::Slice slice_of(Imf::PixelType type, const float* plane, const Imath::Box2i& window) {
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x) + 1;
  const auto offset =
      static_cast<std::ptrdiff_t>(window.min.y) * static_cast<std::ptrdiff_t>(width) + window.min.x;
  // OpenEXR addresses pixels from the origin of the display window and takes its buffers without
  // const.
  auto* base = reinterpret_cast<char*>(const_cast<float*>(plane) -
                                       offset);  // NOLINT(*-const-cast,*-reinterpret-cast)
  return {type, base, sizeof(float), sizeof(float) * width};
}

/// A part of a file whose pixels are read, and what its channels' names get before them.
struct ReadPart {
  int number = 0;
  std::string layer;
};

/// Those that are not deep and whose pixels lie where the first one's do.
std::vector<ReadPart> parts_to_read(const std::filesystem::path& path,
                                    const Imf::MultiPartInputFile& file) {
  std::vector<ReadPart> parts;
  for (int i = 0; i < file.parts(); ++i) {
    const Imf::Header& header = file.header(i);
    if (header.hasType() && Imf::isDeepData(header.type())) continue;
    if (parts.empty()) {
      parts.push_back({i, ""});
    } else if (header.dataWindow() == file.header(parts.front().number).dataWindow()) {
      parts.push_back({i, (header.hasName() ? header.name() : fmt::format("part{}", i + 1)) + "."});
    }
  }
  if (parts.empty())
    throw InputError(fmt::format("{}: is a deep image; flat ones are read", path.string()));
  return parts;
}

/// Names that a part's channels get, in the part's order.
std::vector<std::string> channel_names(const ReadPart& part, const Imf::Header& header) {
  std::vector<std::string> names;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    const std::string name = c.name();
    names.push_back(name.starts_with(part.layer) ? name : part.layer + name);
  }
  return names;
}

/// Values, of 16 bits at least, that a byte of such a part stands for at most; four times as many,
/// since channels may have every other pixel of every other row alone.
double values_per_byte(Imf::Compression compression) {
  constexpr double subsampled = 4;
  switch (compression) {
    case Imf::NO_COMPRESSION:
      return subsampled / 2;
    case Imf::RLE_COMPRESSION:
      // Two bytes say how often which byte is repeated, 128 times at most.
      return subsampled * 64 / 2;
    case Imf::ZIPS_COMPRESSION:
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return subsampled * largest_inflation / 2;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

ExrHeader header_of(const std::filesystem::path& path, const Imf::MultiPartInputFile& file) {
  const std::vector<ReadPart> parts = parts_to_read(path, file);
  const Imf::Header& header = file.header(parts.front().number);
  if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
    throw InputError(
        fmt::format("{}: is a cube map; latitude-longitude images are read", path.string()));
  ExrHeader result{};
  for (const ReadPart& part : parts) {
    for (const std::string& name : channel_names(part, file.header(part.number)))
      result.channels.push_back(name);
  }
  const Imath::Box2i window = header.dataWindow();
  const long long width = 1LL + window.max.x - window.min.x;
  const long long height = 1LL + window.max.y - window.min.y;
  const Imath::Box2i display = header.displayWindow();
  const long long full_width = 1LL + display.max.x - display.min.x;
  const long long full_height = 1LL + display.max.y - display.min.y;
  double most = 0;
  for (const ReadPart& part : parts)
    most = std::max(most, values_per_byte(file.header(part.number).compression()));
  check_file_image_size(path, width, height, result.channels.size(), most);
  check_file_image_size(path, full_width, full_height, 1);
  result.width = static_cast<int>(width);
  result.height = static_cast<int>(height);
  const long long x = 1LL * window.min.x - display.min.x;
  const long long y = 1LL * window.min.y - display.min.y;
  constexpr long long farthest = 1LL << 30;
  if (std::max(std::abs(x), std::abs(y)) > farthest)
    throw InputError(
        fmt::format("{}: its pixels lie at ({}, {}), too far from its image", path.string(), x, y));
  result.window = {static_cast<int>(x), static_cast<int>(y), static_cast<int>(full_width),
                   static_cast<int>(full_height)};
  for (auto a = header.begin(); a != header.end(); ++a) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
    // A part's name and kind say nothing of its image.
    if (text != nullptr && std::string_view(a.name()) != "name" &&
        std::string_view(a.name()) != "type")
      result.metadata.emplace_back(a.name(), text->value());
  }
  return result;
}

Image read_pixels(const std::filesystem::path& path, Imf::MultiPartInputFile& file) {
  const ExrHeader header = header_of(path, file);
  Image image(header.width, header.height, header.channels);
  image.window = header.window;
  image.metadata = header.metadata;
  if (file.parts() == 1 && read_plain_exr(path, image)) return image;
  int channel = 0;
  for (const ReadPart& part : parts_to_read(path, file)) {
    const Imf::Header& part_header = file.header(part.number);
    const Imath::Box2i window = part_header.dataWindow();
    Imf::FrameBuffer buffer;
    for (auto c = part_header.channels().begin(); c != part_header.channels().end(); ++c) {
      // Numbers of other programs' integers are read as numbers.
      const bool words = c.channel().type == Imf::UINT && type_of(c.name()) == Imf::UINT;
      buffer.insert(c.name(),
                    slice_of(words ? Imf::UINT : Imf::FLOAT, image.plane(channel), window));
      ++channel;
    }
    Imf::InputPart pixels(file, part.number);
    pixels.setFrameBuffer(buffer);
    pixels.readPixels(window.min.y, window.max.y);
  }
  return image;
}

/// Opens the file and has it read; whatever goes wrong becomes an InputError that names it.
template <typename Read>
auto read_file(const std::filesystem::path& path, const Read& read) {
  const std::string start = read_start(path);
  if (!start.starts_with(exr_magic))
    throw InputError(
        fmt::format("{}: {}", path.string(), describe_foreign_file(start, "an OpenEXR image")));
  check_exr_attributes(path);
  const Activity activity("reading the image " + path.string());
  try {
    Imf::MultiPartInputFile file(path.c_str(), static_cast<int>(thread_count()));
    return read(path, file);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError(fmt::format("{}: not a readable EXR image: {}", path.string(), e.what()));
  }
}

/// What OpenEXR writes goes through the file, which remembers a failure that OpenEXR's destructors
/// swallow.
class ExrStream : public Imf::OStream {
 public:
  ExrStream(AtomicFile& file, const std::filesystem::path& path)
      : OStream(path.c_str()), file_(file) {}

  void write(const char* data, int size) override {
    file_.write(data, static_cast<std::size_t>(size));
  }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override { file_.seek(position); }

 private:
  AtomicFile& file_;
};

}  // namespace

Image read_exr(const std::filesystem::path& path) { return read_file(path, read_pixels); }

ExrHeader read_exr_header(const std::filesystem::path& path) { return read_file(path, header_of); }

void write_exr(const std::filesystem::path& path, const Image& image, ExrCompression compression) {
  const Activity activity("writing " + path.string());
  const Imath::V2i origin(image.window.x, image.window.y);
  const Imath::Box2i data(origin, origin + Imath::V2i(image.width() - 1, image.height() - 1));
  const Imath::Box2i display(Imath::V2i(0, 0),
                             Imath::V2i(image.window.full_width - 1, image.window.full_height - 1));
  Imf::Header header(
      display, data, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y,
      compression == ExrCompression::zip ? Imf::ZIP_COMPRESSION : Imf::NO_COMPRESSION);
  for (const auto& [name, text] : image.metadata)
    header.insert(name.c_str(), Imf::StringAttribute(text));
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < image.channels().size(); ++c) {
    const Imf::PixelType type = type_of(image.channels()[c]);
    header.channels().insert(image.channels()[c], Imf::Channel(type));
    buffer.insert(image.channels()[c], slice_of(type, image.plane(static_cast<int>(c)), data));
  }
  AtomicFile file(path);
  try {
    ExrStream stream(file, path);
    Imf::OutputFile out(stream, header, static_cast<int>(thread_count()));
    out.setFrameBuffer(buffer);
    out.writePixels(image.height());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    // The file knows best why.
    file.check();
    throw InputError(fmt::format("{}: cannot write: {}", path.string(), e.what()));
  }
  file.commit();
}

}  // namespace facet
