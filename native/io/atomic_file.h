// Outputs that appear whole and together, or not at all.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tessera/base/status.h"

namespace tessera {

// Collects the outputs of a run. Each is written at once to a temporary file beside its target; commit() puts them
// all in place. What is not committed is removed, so that a run that fails or is stopped leaves nothing. Errors are
// kUnwritable, with the target's path as their field.
class AtomicFiles {
 public:
  AtomicFiles() = default;
  ~AtomicFiles();
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;

  // A folder that will hold files; made if it is missing, its parents must be there.
  Result<void> add_folder(const std::string& path);
  // A file. "-" is standard output; that, devices and pipes can have no temporary and are written by commit().
  Result<void> add(const std::string& path, std::string_view bytes);
  // More bytes of the file that was added last.
  Result<void> append(std::string_view bytes);
  // A file that commit() is to remove, once everything is in place; it need not be there.
  void remove(const std::string& path) { removed_.push_back(path); }
  // Once, after the last add(). Where one cannot be put in place, those that were are removed again and what they
  // replaced is back.
  Result<void> commit();

 private:
  struct Pending {
    std::string path;    // as the user named it
    std::string target;  // where links lead
    std::string temporary;
  };
  struct Stream {
    std::string path;
    std::string bytes;
  };

  std::vector<std::string> folders_, removed_;
  std::vector<Pending> files_;
  std::vector<Stream> streams_;
  bool last_is_stream_ = false;
};

}  // namespace tessera
