#include "tessera/cli/checkpoint.h"

#include <filesystem>
#include <utility>

#include "tessera/cli/signals.h"
#include "tessera/io/atomic_file.h"
#include "tessera/io/file.h"

namespace tessera {

Result<void> Checkpoint::read() {
  std::error_code error;
  if (path_.empty() || !std::filesystem::exists(path_, error)) return {};
  auto text = read_file(path_);
  if (!text) return tl::unexpected<Status>(std::move(text.error()));
  earlier_ = *std::move(text);
  return {};
}

void Checkpoint::offer(const std::function<std::string()>& state) {
  constexpr double kBetween_s = 10;
  if (since_written_.seconds() < kBetween_s && stop_reason() == StopReason::kNone) return;
  const UnkillableScope unkillable;
  AtomicFiles files;
  if (files.add(path_, state()).and_then([&] { return files.commit(); })) kept_ = path_;
  since_written_ = {};
}

}  // namespace tessera
