#include "tessera/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

namespace tessera {
namespace {

tl::unexpected<Status> unwritable(const std::string& path, int error) {
  return fail(StatusCode::kUnwritable, path == "-" ? "standard output" : path,
              "cannot be written: " + std::generic_category().message(error));
}

// The error number, 0 for none.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

// Takes `descriptor`. A full disk may show itself only when the file is closed.
int write_and_close(int descriptor, std::string_view bytes) {
  const int error = write_all(descriptor, bytes);
  const int close_error = close(descriptor) == 0 ? 0 : errno;
  return error ? error : close_error;
}

// What has no place beside it for a temporary file, or must not be replaced by one.
bool is_stream(const std::string& path, const struct stat* info) {
  const auto starts_with = [&](std::string_view start) { return path.compare(0, start.size(), start) == 0; };
  return path == "-" || starts_with("/dev/std") || starts_with("/dev/fd/") || starts_with("/proc/") ||
         (info && !S_ISREG(info->st_mode));
}

// Where a chain of links ends, so that the link stays and the file behind it changes.
std::string behind_links(const std::string& path) {
  std::error_code error;
  const auto target = std::filesystem::canonical(path, error);
  return error ? path : target.string();
}

// A name in the folder of `target` that `take` finds free; what that returns, -1 with errno set.
template <class Take>
int take_name_beside(const std::string& target, std::string& name, const Take& take) {
  const std::size_t slash = target.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : target.substr(0, slash + 1);
  for (int attempt = 0;; ++attempt) {
    name = fmt::format("{}.tessera-{}-{}.tmp", folder, getpid(), attempt);
    const int taken = take(name.c_str());
    if (taken >= 0 || errno != EEXIST) return taken;
  }
}

// A new file in the folder of `target`, open for writing; -1 with errno set.
int create_beside(const std::string& target, std::string& name) {
  return take_name_beside(target, name,
                          [](const char* path) { return open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); });
}

// A second name for what is at `target` now; empty where there is nothing, or the file system knows no such names.
std::string second_name(const std::string& target) {
  std::string name;
  const int linked = take_name_beside(target, name, [&](const char* path) { return link(target.c_str(), path); });
  return linked == 0 ? name : "";
}

}  // namespace

AtomicFiles::~AtomicFiles() {
  for (const Pending& file : files_) unlink(file.temporary.c_str());
  for (const std::string& folder : folders_) rmdir(folder.c_str());  // only if it is empty
}

Result<void> AtomicFiles::add_folder(const std::string& path) {
  if (mkdir(path.c_str(), 0777) == 0) {
    folders_.push_back(path);
  } else if (errno != EEXIST) {
    return fail(StatusCode::kUnwritable, path, "cannot be made: " + std::generic_category().message(errno));
  }
  return {};
}

Result<void> AtomicFiles::add(const std::string& path, std::string_view bytes) {
  struct stat info {};
  const bool exists = stat(path.c_str(), &info) == 0;
  if (path != "-" && exists && S_ISDIR(info.st_mode)) return unwritable(path, EISDIR);
  last_is_stream_ = is_stream(path, exists ? &info : nullptr);
  if (last_is_stream_) {
    streams_.push_back({path, std::string(bytes)});
    return {};
  }
  Pending file{path, exists ? behind_links(path) : path, {}};
  const int descriptor = create_beside(file.target, file.temporary);
  if (descriptor < 0) return unwritable(path, errno);
  files_.push_back(file);
  if (exists) fchmod(descriptor, info.st_mode & 07777);
  if (const int error = write_and_close(descriptor, bytes)) return unwritable(path, error);
  return {};
}

Result<void> AtomicFiles::append(std::string_view bytes) {
  if (last_is_stream_) {
    streams_.back().bytes += bytes;
    return {};
  }
  const Pending& file = files_.back();
  const int descriptor = open(file.temporary.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0) return unwritable(file.path, errno);
  if (const int error = write_and_close(descriptor, bytes)) return unwritable(file.path, error);
  return {};
}

Result<void> AtomicFiles::commit() {
  for (const Stream& stream : streams_) {
    const int descriptor =
        stream.path == "-" ? dup(STDOUT_FILENO) : open(stream.path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor < 0) return unwritable(stream.path, errno);
    if (const int error = write_and_close(descriptor, stream.bytes)) return unwritable(stream.path, error);
  }
  // One alone is replaced in a single step. Of several the older ones are kept until all are in place.
  std::vector<std::string> older;
  for (std::size_t i = 0; i < files_.size(); ++i) {
    older.push_back(files_.size() > 1 ? second_name(files_[i].target) : "");
    if (std::rename(files_[i].temporary.c_str(), files_[i].target.c_str()) == 0) continue;
    const int error = errno;
    if (!older[i].empty()) unlink(older[i].c_str());
    for (std::size_t k = 0; k < i; ++k) {
      if (older[k].empty())
        unlink(files_[k].target.c_str());
      else
        std::rename(older[k].c_str(), files_[k].target.c_str());
    }
    return unwritable(files_[i].path, error);
  }
  for (const std::string& name : older)
    if (!name.empty()) unlink(name.c_str());
  for (const std::string& path : removed_) unlink(path.c_str());
  files_.clear();
  folders_.clear();
  return {};
}

}  // namespace tessera
