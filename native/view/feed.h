// From the thread that works to the window.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tessera/view/content.h"

namespace tessera::view {

struct News {
  enum class State { kWorking, kDone, kFailed };
  std::optional<Content> content;  // since the last time
  std::string stage;
  double fraction = 0;  // of the work, 0..1
  State state = State::kWorking;
};

// A mailbox. The newest content takes the place of one that the window has not fetched.
class Feed {
 public:
  void show(Content content) {
    const std::lock_guard lock(mutex_);
    news_.content = std::move(content);
  }
  void stage(std::string_view name) {
    const std::lock_guard lock(mutex_);
    news_.stage = name;
  }
  void progress(double fraction) {
    const std::lock_guard lock(mutex_);
    news_.fraction = fraction;
  }
  // Nothing comes after it.
  void end(bool well) {
    const std::lock_guard lock(mutex_);
    news_.state = well ? News::State::kDone : News::State::kFailed;
  }
  // Whether the window has fetched what was shown last: more would be drawn at once.
  bool is_awaited() const {
    const std::lock_guard lock(mutex_);
    return !news_.content;
  }

  News take() {
    const std::lock_guard lock(mutex_);
    News news = news_;
    news_.content.reset();
    return news;
  }

 private:
  mutable std::mutex mutex_;
  News news_;
};

}  // namespace tessera::view
