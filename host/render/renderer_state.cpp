// What a render holds: its film, and the state that it can be continued from.
#include "render/renderer.h"

namespace facet {

Film Renderer::sums(Sums of) const {
  Film film = make_film(settings_.crop_width(), settings_.crop_height(), settings_.window(),
                        features_.variance);
  films_.at(static_cast<std::size_t>(of)).read(film, square_scale_);
  return film;
}

Film Renderer::film() const { return film_of(settings_.goal(), *this); }

RenderState Renderer::state() const {
  RenderState state = state_of(plan_, settings_.goal());
  state.film = sums(Sums::image);
  state.image = films_.front().words();
  if (films_.size() > 1) state.trial = films_.back().words();
  state.statistics = statistics_;
  return state;
}

void Renderer::restore(const RenderState& state) {
  plan_.restore(state.plan);
  films_.front().set_words(state.image);
  if (films_.size() > 1) films_.back().set_words(state.trial);
  add_counts(statistics_, state.statistics);
}

}  // namespace facet
