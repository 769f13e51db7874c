// Work in a process of its own: what it breaks is its own.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tessera/cli/checkpoint.h"

namespace tessera {

struct ChildEnd {
  int status = 0;                     // what it exited with; 128 + the signal that killed it
  double seconds = 0;                 // it took
  std::vector<std::string> messages;  // lines of its standard error, without "tessera: "; the last ones of many
};

// Runs `work` in a copy of this process, which must have no other threads; what it returns is the exit status. The
// copy dies with this object, and with this process however that ends.
class Child {
 public:
  explicit Child(const std::function<int()>& work);
  ~Child();
  Child(Child&& other) noexcept;
  Child& operator=(Child&& other) noexcept;

  // Once wait_for() has named it.
  ChildEnd end();

 private:
  friend std::size_t wait_for(const std::vector<Child*>& children);
  void hear();  // what it has written

  pid_t id_ = -1;  // -1: gone
  int pipe_ = -1;
  std::string heard_;
  Stopwatch clock_;
};

// Waits until one of them has closed its standard error, and ends; its index. Or the number of children, where a
// signal came.
std::size_t wait_for(const std::vector<Child*>& children);

}  // namespace tessera
