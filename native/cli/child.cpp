#include "tessera/cli/child.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace tessera {
namespace {

constexpr std::size_t kMostHeard = 1 << 16;  // bytes

std::vector<std::string> lines_of(std::string_view text) {
  constexpr std::string_view kPrefix = "tessera: ";
  std::vector<std::string> lines;
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    if (line.substr(0, kPrefix.size()) == kPrefix) line.remove_prefix(kPrefix.size());
    if (!line.empty()) lines.emplace_back(line);
  }
  return lines;
}

}  // namespace

Child::Child(const std::function<int()>& work) {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) std::abort();
  id_ = fork();
  if (id_ < 0) std::abort();
  if (id_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(ends[1], STDERR_FILENO);
    std::_Exit(work());
  }
  close(ends[1]);
  pipe_ = ends[0];
}

Child::Child(Child&& other) noexcept { *this = std::move(other); }

Child& Child::operator=(Child&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(pipe_, other.pipe_);
  std::swap(heard_, other.heard_);
  std::swap(clock_, other.clock_);
  return *this;
}

Child::~Child() {
  if (pipe_ >= 0) close(pipe_);
  if (id_ < 0) return;
  kill(id_, SIGTERM);  // it removes what it has not finished
  while (waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Child::hear() {
  char buffer[4096];
  const ssize_t count = read(pipe_, buffer, sizeof buffer);
  if (count > 0) {
    heard_.append(buffer, static_cast<std::size_t>(count));
    if (heard_.size() > 2 * kMostHeard) heard_.erase(0, heard_.size() - kMostHeard);
  } else if (count == 0 || errno != EINTR) {
    close(pipe_);
    pipe_ = -1;
  }
}

ChildEnd Child::end() {
  int state = 0;
  while (waitpid(id_, &state, 0) < 0 && errno == EINTR) {
  }
  id_ = -1;
  return {WIFSIGNALED(state) ? 128 + WTERMSIG(state) : WEXITSTATUS(state), clock_.seconds(), lines_of(heard_)};
}

std::size_t wait_for(const std::vector<Child*>& children) {
  for (;;) {
    std::vector<pollfd> ends;
    for (const Child* child : children) ends.push_back({child->pipe_, POLLIN, 0});
    if (poll(ends.data(), ends.size(), -1) < 0) return children.size();
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (ends[i].revents == 0) continue;
      children[i]->hear();
      if (children[i]->pipe_ < 0) return i;
    }
  }
}

}  // namespace tessera
