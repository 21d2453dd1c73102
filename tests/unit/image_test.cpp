// EXR and PNG files: what is written is read back, and a failed write harms nothing.
#include <facet/film.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>

#include "core/atomic_file.h"
#include "image/files.h"
#include "support/images.h"
#include "support/input.h"

namespace facet {

namespace {

using test::expect_message;
using test::input_error_of;
using test::make_image;

using Names = std::vector<std::string>;

/// Lets no file grow beyond a size, as a full disk does.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    (void)std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

void expect_equal(const Image& a, const Image& b) {
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  ASSERT_EQ(a.channels().size(), b.channels().size());
  for (std::size_t c = 0; c < a.channels().size(); ++c) {
    const int other = b.find_channel(a.channels()[c]);
    ASSERT_GE(other, 0) << a.channels()[c];
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x)
        EXPECT_EQ(a.at(x, y, static_cast<int>(c)), b.at(x, y, other));
    }
  }
}

class ImageTest : public ::testing::Test {
 protected:
  /// Expects that the write fails with an InputError that names the file.
  void expect_failure(const std::string& name,
                      const std::function<void(const std::filesystem::path&)>& write) const {
    const std::filesystem::path path = folder_.file(name);
    expect_message(input_error_of([&] { return write(path), 0; }), path.string(), {"cannot write"});
  }

  test::TemporaryFolder folder_;
};

TEST_F(ImageTest, ChannelsAreFoundByName) {
  const Image image(2, 3, {"R", "variance.R"});
  EXPECT_EQ(image.find_channel("variance.R"), 1);
  EXPECT_EQ(image.find_channel("G"), -1);
  EXPECT_EQ(image.at(1, 2, 1), 0);
  EXPECT_EQ(image.window.full_width, 2);
  EXPECT_EQ(image.window.full_height, 3);
}

TEST_F(ImageTest, ExrKeepsEveryBit) {
  Image image = make_image(13, 7, {"R", "G", "B", "variance.R", "samples.nonzero"});
  image.at(0, 0, 0) = std::numeric_limits<float>::infinity();
  image.at(1, 0, 0) = std::numeric_limits<float>::denorm_min();
  image.at(2, 0, 0) = -0.0F;
  write_exr(folder_.file("a.exr"), image);
  const Image back = read_exr(folder_.file("a.exr"));
  expect_equal(image, back);
  EXPECT_TRUE(std::signbit(back.at(2, 0, back.find_channel("R"))));
}

TEST_F(ImageTest, ExrKeepsWindowAndMetadata) {
  Image image = make_image(3, 2, {"R", "G", "B"});
  image.window = {5, 4, 16, 9};
  image.metadata = {{"facet.scene", "cbox.xml"},
                    {"facet.seed", "7"},
                    {"facet.a-name-of-more-than-31-characters", ""}};
  write_exr(folder_.file("a.exr"), image);
  const Image back = read_exr(folder_.file("a.exr"));
  expect_equal(image, back);
  EXPECT_EQ(back.window.x, 5);
  EXPECT_EQ(back.window.y, 4);
  EXPECT_EQ(back.window.full_width, 16);
  EXPECT_EQ(back.window.full_height, 9);
  for (const auto& entry : image.metadata)
    EXPECT_NE(std::find(back.metadata.begin(), back.metadata.end(), entry), back.metadata.end())
        << entry.first;
}

TEST_F(ImageTest, UnreadableExrFilesAreNamed) {
  folder_.write("text.exr", "this is no image\n");
  folder_.write("empty.exr", "");
  expect_message(input_error_of([&] { return read_exr(folder_.file("text.exr")); }),
                 folder_.file("text.exr").string(),
                 {"it is not an OpenEXR image; it begins with \"this is no image\""});
  expect_message(input_error_of([&] { return read_exr(folder_.file("empty.exr")); }),
                 folder_.file("empty.exr").string(), {"it is empty"});
  const auto none = folder_.file("none.exr");
  expect_message(input_error_of([&] { return read_exr(none); }), none.string(), {"no such file"});
}

TEST_F(ImageTest, AFolderIsNotReportedAsMissing) {
  const std::string message = input_error_of([&] { return read_exr(folder_.path()); });
  EXPECT_EQ(message.find("no such file"), std::string::npos) << message;
}

TEST_F(ImageTest, TruncatedExrFilesAreErrors) {
  write_exr(folder_.file("a.exr"), make_image(40, 40, {"R", "G", "B"}));
  const std::string whole = folder_.read("a.exr");
  for (std::size_t size = 1; size < whole.size(); size += 1 + whole.size() / 50) {
    folder_.write("cut.exr", whole.substr(0, size));
    SCOPED_TRACE(size);
    (void)input_error_of([&] { return read_exr(folder_.file("cut.exr")); });
  }
}

TEST_F(ImageTest, DamagedExrFilesNeverCrash) {
  write_exr(folder_.file("a.exr"), make_image(8, 8, {"R", "G", "B"}));
  const std::string whole = folder_.read("a.exr");
  std::size_t errors = 0;
  for (std::size_t i = 0; i < whole.size(); i += 3) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
    folder_.write("bad.exr", damaged);
    try {
      (void)read_exr(folder_.file("bad.exr"));
    } catch (const InputError&) {
      ++errors;
    }
  }
  EXPECT_GT(errors, 0U);
}

TEST_F(ImageTest, WritingLeavesOnlyTheFile) {
  const Image image = make_image(4, 4, {"R", "G", "B"});
  folder_.write("a.exr", "old");
  write_exr(folder_.file("a.exr"), image);
  write_png(folder_.file("a.png"), image, 0);
  EXPECT_EQ(folder_.names(), (Names{"a.exr", "a.png"}));
  expect_equal(image, read_exr(folder_.file("a.exr")));
}

TEST_F(ImageTest, FoldersAreNotReplaced) {
  const Image image = make_image(4, 4, {"R", "G", "B"});
  std::filesystem::create_directory(folder_.file("a"));
  expect_failure("a", [&](const auto& path) { write_exr(path, image); });
  expect_failure("a", [&](const auto& path) { write_png(path, image, 0); });
  expect_failure("a", check_writable);
  EXPECT_TRUE(std::filesystem::is_directory(folder_.file("a")));
  EXPECT_EQ(folder_.names(), Names{"a"});
}

TEST_F(ImageTest, MissingFoldersAreErrors) {
  const Image image = make_image(4, 4, {"R", "G", "B"});
  expect_failure("none/a.exr", [&](const auto& path) { write_exr(path, image); });
  expect_failure("none/a.png", [&](const auto& path) { write_png(path, image, 0); });
  expect_message(input_error_of([&] { return check_writable(folder_.file("none/a.exr")), 0; }),
                 folder_.file("none/a.exr").string(), {"no such folder"});
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(ImageTest, CheckWritableLeavesNothingBehind) {
  check_writable(folder_.file("new.exr"));
  EXPECT_TRUE(folder_.names().empty());
  folder_.write("old.exr", "old");
  check_writable(folder_.file("old.exr"));
  EXPECT_EQ(folder_.names(), Names{"old.exr"});
  EXPECT_EQ(folder_.read("old.exr"), "old");
}

TEST_F(ImageTest, UncommittedFilesVanish) {
  {
    AtomicFile file(folder_.file("a.txt"));
    file.write("new");
    EXPECT_FALSE(std::filesystem::exists(folder_.file("a.txt")));
  }
  EXPECT_TRUE(folder_.names().empty());
}

/// Writers that swallow exceptions, as OpenEXR's destructors do, must not commit what they could
/// not write.
TEST_F(ImageTest, AFailedWriteIsNotForgotten) {
  folder_.write("a.txt", "old");
  {
    AtomicFile file(folder_.file("a.txt"));
    {
      const FullDisk full(10);
      input_error_of([&] { return file.write(std::string(100, 'x')), 0; });
    }
    EXPECT_NE(input_error_of([&] { return file.write("more"), 0; }), "");
    EXPECT_NE(input_error_of([&] { return file.commit(), 0; }), "");
  }
  EXPECT_EQ(folder_.read("a.txt"), "old");
  EXPECT_EQ(folder_.names(), Names{"a.txt"});
}

TEST_F(ImageTest, AKilledProgramLeavesNoTemporaryFile) {
  const int unnamed = ::open(folder_.file(".").c_str(), O_WRONLY | O_TMPFILE, 0600);
  if (unnamed < 0) GTEST_SKIP() << "a file system without files that have no name";
  ::close(unnamed);
  const pid_t child = ::fork();
  if (child == 0) {
    AtomicFile file(folder_.file("a.txt"));
    file.write("new");
    (void)::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(ImageTest, StaleTemporaryFilesAreSwept) {
  const auto stale =
      folder_.write(".facet-0123456789abcdef.part", "left by a program that was killed");
  std::filesystem::last_write_time(
      stale, std::filesystem::file_time_type::clock::now() - std::chrono::hours(2));
  folder_.write(".facet-fedcba9876543210.part", "of a program that is writing");
  folder_.write(".facet-notes", "somebody's own");
  AtomicFile(folder_.file("a.txt")).commit();
  EXPECT_EQ(folder_.names(), (Names{".facet-fedcba9876543210.part", ".facet-notes", "a.txt"}));
}

TEST_F(ImageTest, LongNames) {
  write_exr(folder_.file(std::string(251, 'a') + ".exr"), Image(1, 1, {"R", "G", "B"}));
  const std::string message = test::input_error_of([&] {
    write_exr(folder_.file(std::string(252, 'a') + ".exr"), Image(1, 1, {"R", "G", "B"}));
  });
  EXPECT_NE(message.find("255 bytes"), std::string::npos) << message;
}

/// Wherever the disk fills up, to the last byte: OpenEXR completes a file in a destructor, which
/// swallows the error.
TEST_F(ImageTest, AFullDiskLeavesTheOldFile) {
  Image image(40, 30, {"R", "G", "B"});
  for (int i = 0; i < 1200; ++i) image.plane(0)[i] = static_cast<float>(i * i % 977);
  for (const char* name : {"a.exr", "a.png"}) {
    const auto write = [&] {
      if (std::string_view(name) == "a.exr") {
        write_exr(folder_.file(name), image);
      } else {
        write_png(folder_.file(name), image, 0);
      }
    };
    write();
    const std::size_t size = std::filesystem::file_size(folder_.file(name));
    folder_.write(name, "old");
    for (std::size_t limit = 0; limit < size; limit = limit + 40 < size ? limit + 37 : limit + 1) {
      std::string message;
      {
        const FullDisk full(limit);
        message = test::input_error_of(write);
      }
      EXPECT_NE(message.find("cannot write: File too large"), std::string::npos)
          << limit << ": " << message;
      EXPECT_EQ(folder_.read(name), "old") << limit << " of " << size;
      EXPECT_EQ(std::ranges::count_if(folder_.names(),
                                      [](const std::string& n) { return n.ends_with(".part"); }),
                0);
    }
    write();
    EXPECT_EQ(std::filesystem::file_size(folder_.file(name)), size);
  }
}

}  // namespace

}  // namespace facet
