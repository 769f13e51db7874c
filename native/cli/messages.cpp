#include "tessera/cli/messages.h"

#include <cstdio>

namespace tessera {

int exit_status(StatusCode code) {
  switch (code) {
    case StatusCode::kInternal: return 1;
    case StatusCode::kInvalidParameter: return kExitUsage;
    case StatusCode::kInvalidInput: return 3;
    case StatusCode::kUnwritable: return 4;
    case StatusCode::kTimeout: return 124;
    case StatusCode::kCancelled: return 130;
  }
  return 1;
}

void print_message(std::string_view message) {
  std::string line = "tessera: ";
  for (const char c : message) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    line += control ? '?' : c;
  }
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

int print_problems(const Problems& problems) {
  for (const Status& problem : problems) {
    print_message(problem.field.empty() ? problem.message : problem.field + ": " + problem.message);
  }
  return exit_status(problems.front().code);
}

}  // namespace tessera
