// Renders that several backends share: no bit depends on who renders what, and failures are the
// others' work.
#include "door/shared_backend.h"

#include <gtest/gtest.h>

#include <atomic>

#include "core/error.h"
#include "door/film_tree.h"
#include "door/shared_rendering.h"
#include "image/film.h"
#include "reference/reference_backend.h"
#include "support/render.h"
#include "support/scenes.h"

namespace facet::test {

namespace {

/// A backend whose films follow from samples and pixels alone, and that fails or differs on
/// purpose.
class FakeBackend : public TestableBackend {
 public:
  std::atomic<int> starts{0};
  int fails_at = 0;  ///< number of the start() that fails; 0: none
  ErrorKind failure = ErrorKind::device;
  double error = 0;            ///< that its values are off by
  std::uint64_t slowness = 0;  ///< milliseconds of a sample

  [[nodiscard]] std::string name() const override { return "fake"; }
  [[nodiscard]] std::string driver() const override { return "none"; }
  using TestableBackend::start;
  [[nodiscard]] std::unique_ptr<Rendering> start(const ScenePtr& scene,
                                                 const RenderSettings& settings) override;
  [[nodiscard]] std::unique_ptr<statistics::BsdfEvaluator> evaluator(
      const Bsdf& /*bsdf*/, LobeSampling /*sampling*/) override {
    return nullptr;
  }
};

class FakeRendering : public RecordedRendering {
 public:
  FakeRendering(const FakeBackend& backend, const Scene& scene, const RenderSettings& settings)
      : RecordedRendering(backend, "fake", Precision::float_, scene, settings),
        backend_(backend),
        settings_(settings),
        film_(make_film(settings.crop_width(), settings.crop_height(), settings.window(), true)) {}

  void run(const ProgressCallback& progress) override {
    for (std::uint32_t s = settings_.samples.begin; s < settings_.samples.end; ++s) {
      for (std::size_t i = 0; i < film_.pixels.size(); ++i) {
        // Sums of such values depend on their order in the last bits.
        const double value = 1.0 / (3.0 + 7.0 * s + static_cast<double>(i)) + backend_.error;
        film_.pixels[i].add({value, value / 3, value / 7});
      }
      statistics_.samples += film_.pixels.size();
      std::this_thread::sleep_for(std::chrono::milliseconds(backend_.slowness));
      const bool last = s + 1 == settings_.samples.end;
      if (progress && !progress(0, statistics_) && !last) return;
    }
    note({StoppedBy::samples, settings_.samples, false});
  }
  std::vector<Radiance> sample(std::uint32_t /*index*/) override { return {}; }
  [[nodiscard]] Film film() const override {
    Film film = film_;
    film.record = record();
    return film;
  }
  [[nodiscard]] const RenderStatistics& statistics() const override { return statistics_; }
  [[nodiscard]] RenderState state() const override { return {}; }
  [[nodiscard]] bool is_good_moment() const override { return false; }
  void restore(const RenderState& /*state*/) override {}

 private:
  const FakeBackend& backend_;
  RenderSettings settings_;
  Film film_;
  RenderStatistics statistics_;
};

std::unique_ptr<Rendering> FakeBackend::start(const ScenePtr& scene,
                                              const RenderSettings& settings) {
  if (++starts == fails_at) throw Error(failure, "the fake fails");
  return std::make_unique<FakeRendering>(*this, *scene, settings);
}

class SharedBackendTest : public ::testing::Test {
 protected:
  static ScenePtr make() {
    Scene scene = make_scene("path_mis");
    set_camera(scene, 8, 40, {0, 0, -3}, {0, 0, 0});
    return std::make_shared<const Scene>(std::move(scene));
  }

  /// A backend of so many fakes, which the test changes before it renders.
  void share(std::size_t count) {
    std::vector<std::unique_ptr<TestableBackend>> backends;
    fakes_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      auto fake = std::make_unique<FakeBackend>();
      fakes_.push_back(fake.get());
      backends.push_back(std::move(fake));
    }
    backend_ = share_renders(std::move(backends));
  }
  [[nodiscard]] Film render(int samples) const {
    return backend_->render(scene_, {.samples = samples, .variance = true});
  }

  ScenePtr scene_ = make();
  std::unique_ptr<Backend> backend_;
  std::vector<FakeBackend*> fakes_;
};

TEST_F(SharedBackendTest, NoBitDependsOnHowManyShareOrHowFast) {
  for (const int samples : {1, 2, 3, 31, 33, 100, 257}) {
    share(1);
    const Film one = render(samples);
    EXPECT_EQ(one.record.samples.text(), "0:" + std::to_string(samples));
    EXPECT_EQ(one.record.stopped_by, StoppedBy::samples);
    for (const std::size_t count : {std::size_t{2}, std::size_t{5}}) {
      share(count);
      fakes_[0]->slowness = 1;
      const Film film = render(samples);
      EXPECT_TRUE(film.pixels == one.pixels) << samples << " " << count;
      EXPECT_TRUE(backend_->remarks().empty());
    }
  }
}

TEST_F(SharedBackendTest, EverySampleIsThereOnce) {
  share(3);
  const Film film = render(100);
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    ASSERT_EQ(film.pixels[i].samples, 100U);
    double sum = 0;
    for (int s = 0; s < 100; ++s) sum += 1.0 / (3.0 + 7.0 * s + static_cast<double>(i));
    ASSERT_NEAR(film.pixels[i].values[0], sum, 1e-12);
  }
}

TEST_F(SharedBackendTest, TheFirstOfAPartIsItsOwn) {
  share(2);
  const Film film = backend_->render(scene_, {.sample_range = SampleRange{40, 50}});
  EXPECT_EQ(film.record.samples.text(), "40:50");
  EXPECT_EQ(film.pixels[0].samples, 10U);
}

TEST_F(SharedBackendTest, ADeviceThatFailsLeavesItsSharesToTheOthers) {
  share(1);
  const Film one = render(64);
  for (const int start : {1, 2, 3}) {
    share(3);
    fakes_[1]->fails_at = start;
    // So that it comes to more than one.
    for (FakeBackend* fake : fakes_) fake->slowness = 1;
    const Film film = render(64);
    EXPECT_TRUE(film.pixels == one.pixels);
    // On a busy machine the others may have done all before it comes to fail.
    ASSERT_EQ(backend_->remarks().size(), fakes_[1]->starts >= start ? 1U : 0U);
    for (const std::string& remark : backend_->remarks())
      EXPECT_EQ(remark, "the fake fails; the other devices go on");
  }
}

TEST_F(SharedBackendTest, TheLastFailureIsTheRenders) {
  for (const int start : {1, 2}) {
    // Whichever is the last, also where they fail at once.
    for (int i = 0; i < 50; ++i) {
      share(3);
      for (FakeBackend* fake : fakes_) fake->fails_at = start;
      EXPECT_THROW((void)render(64), Error);
    }
  }
  share(2);
  for (FakeBackend* fake : fakes_) {
    fake->fails_at = 2;
    fake->failure = ErrorKind::input;
  }
  try {
    (void)render(64);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
  }
}

TEST_F(SharedBackendTest, DevicesThatRoundOtherwiseAreTold) {
  share(3);
  fakes_[2]->error = 1e-15;
  (void)render(64);
  ASSERT_EQ(backend_->remarks().size(), 1U);
  EXPECT_NE(backend_->remarks()[0].find("first sample of 64 of 64 pixels"), std::string::npos)
      << backend_->remarks()[0];
}

TEST(SharedRendering, TheSlowAreNotWaitedFor) {
  // Nobody else has been measured.
  EXPECT_TRUE(is_worth_starting(100, {}, 1));
  EXPECT_FALSE(is_worth_starting(100, {}, 0));
  // Two others do a share in a second each, and are at one each.
  EXPECT_TRUE(is_worth_starting(4.9, {1, 1}, 8));
  EXPECT_FALSE(is_worth_starting(5.1, {1, 1}, 8));
  EXPECT_TRUE(is_worth_starting(1, {1}, 1));
  EXPECT_FALSE(is_worth_starting(100, {1}, 31));
}

TEST_F(SharedBackendTest, AnEndedRenderKeepsWholeShares) {
  share(2);
  for (FakeBackend* fake : fakes_) fake->slowness = 2;
  int calls = 0;
  const Film film = backend_->render(
      scene_, {.samples = 3200, .progress = [&](double done, const RenderStatistics& statistics) {
                 EXPECT_GE(done, 0);
                 EXPECT_LE(done, 1);
                 EXPECT_EQ(statistics.planned, 3200U * 64);
                 return ++calls < 20;
               }});
  EXPECT_EQ(film.record.stopped_by, StoppedBy::interrupt);
  EXPECT_EQ(film.pixels[0].samples, film.record.samples.count());
  EXPECT_LT(film.pixels[0].samples, 3200U);
  EXPECT_GE(film.pixels[0].samples, 1U);
}

TEST_F(SharedBackendTest, WhatTheCallerThrowsEndsTheOthers) {
  share(2);
  for (FakeBackend* fake : fakes_) fake->slowness = 1;
  const auto fails = [](double, const RenderStatistics&) -> bool {
    throw std::runtime_error("enough");
  };
  // A million milliseconds otherwise.
  EXPECT_THROW((void)backend_->render(scene_, {.samples = 1000000, .progress = fails}),
               std::runtime_error);
}

TEST_F(SharedBackendTest, GoalsOfOneDeviceAreRefused) {
  share(2);
  EXPECT_THROW((void)backend_->render(scene_, {.error = 0.1}), Error);
  EXPECT_THROW((void)backend_->render(scene_, {.deadline = Clock::now()}), Error);
  EXPECT_THROW((void)backend_->render(scene_, {.samples = 64, .adaptive = true}), Error);
}

TEST(FilmTree, SumsTheSameInWhateverOrder) {
  const auto film_of = [](std::uint32_t share) {
    Film film = make_film(1, 1, {0, 0, 1, 1}, true);
    const double value = 1.0 / (3 + share);
    film.pixels[0].add({value, value, value});
    film.record.samples.add({share, share + 1});
    return film;
  };
  std::optional<Film> expected;
  for (const std::uint32_t step : {1U, 3U, 5U, 7U, 15U}) {
    FilmTree tree;
    EXPECT_FALSE(tree.sum());
    for (std::uint32_t i = 0; i < 16; ++i) tree.add(i * step % 16, film_of(i * step % 16));
    const std::optional<Film> sum = tree.sum();
    ASSERT_TRUE(sum);
    EXPECT_EQ(sum->record.samples.text(), "0:16");
    if (!expected) expected = sum;
    EXPECT_TRUE(sum->pixels == expected->pixels) << step;
  }
}

}  // namespace

}  // namespace facet::test
