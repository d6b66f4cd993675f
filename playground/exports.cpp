// What JavaScript calls (page/engine_worker.js). Texts are UTF-8 and valid until the next call; errors are
// {"error": "why"}.
#include <emscripten/emscripten.h>

#include <exception>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "playground/engine.hpp"
#include "report/palette.hpp"

namespace {

std::unique_ptr<spf::playground::Engine> engine;
std::string answer;

double seconds() {
  return 1e-3 * emscripten_get_now();
}

template <class Job>
const char* answered(Job&& job) {
  try {
    answer = job();
  } catch (const std::exception& error) {
    answer =
        nlohmann::json{{"error", error.what()}}.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  }
  return answer.c_str();
}

}  // namespace

extern "C" {

/// Begins a scene; one that cannot run leaves the last one as it is.
EMSCRIPTEN_KEEPALIVE const char* spf_begin(const char* scene) {
  return answered([scene] {
    engine = std::make_unique<spf::playground::Engine>(scene, seconds);
    return engine->advance(0.01);
  });
}

EMSCRIPTEN_KEEPALIVE const char* spf_advance(double until) {
  return answered([until] {
    if (!engine) throw std::logic_error{"no scene has begun"};
    return engine->advance(until);
  });
}

EMSCRIPTEN_KEEPALIVE const char* spf_change(const char* change) {
  return answered([change] {
    if (!engine) throw std::logic_error{"no scene has begun"};
    engine->change(change);
    return std::string{"{}"};
  });
}

EMSCRIPTEN_KEEPALIVE const char* spf_palette() {
  return answered([] { return spf::palette_css(); });
}

}  // extern "C"
