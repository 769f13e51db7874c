#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace tessera {

// The SHA-256 of bytes that come one after the other.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);
  std::string hex();  // once, after the last add()

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The SHA-256 of `bytes` in 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace tessera
