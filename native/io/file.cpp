#include "tessera/io/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace tessera {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{4} << 30;
constexpr std::size_t kStep = std::size_t{1} << 16;

// What is left behind `descriptor`; `expected` saves growing step by step.
Result<std::string> read_all(int descriptor, std::size_t expected, const std::string& path) {
  std::string bytes;
  std::size_t size = 0;
  for (;;) {
    if (size == bytes.size()) bytes.resize(std::max(expected + 1, size + std::max(kStep, size / 2)));
    const ssize_t got = read(descriptor, bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) return fail(StatusCode::kCancelled, path, "interrupted");
    if (got < 0)
      return fail(StatusCode::kInvalidInput, path, "cannot be read: " + std::generic_category().message(errno));
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
    if (size > kMaxBytes) return fail(StatusCode::kInvalidInput, path, "is larger than 4 GiB");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::string input_name(const std::string& path) { return path == "-" ? "standard input" : path; }

Result<std::string> read_file(const std::string& path) {
  if (path == "-") return read_all(STDIN_FILENO, 0, input_name(path));
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0 && errno == EINTR) return fail(StatusCode::kCancelled, path, "interrupted");
  if (descriptor < 0) {
    return fail(StatusCode::kInvalidInput, path, "cannot be opened: " + std::generic_category().message(errno));
  }
  struct stat info {};
  const bool sized = fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode);
  auto bytes = read_all(descriptor, sized ? static_cast<std::size_t>(info.st_size) : 0, path);
  close(descriptor);
  return bytes;
}

}  // namespace tessera
