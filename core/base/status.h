// How errors travel: as values. Nothing in core throws on bad input, prints or exits.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace tessera {

// What kind of trouble it is. The command line turns each into an exit status, the page into an alert.
enum class StatusCode {
  kInternal,          // a fault of ours
  kInvalidParameter,  // a parameter, key or combination that cannot be
  kInvalidInput,      // a picture or file that cannot be used
  kUnwritable,        // an output that cannot be written
  kTimeout,           // out of time
  kCancelled,         // the user stopped it
};

// One problem. `field` names the parameter ("halfSide"), input ("drawing") or path it is about; may be empty.
// `message` is one line without a full stop: what is wrong and what was expected.
struct Status {
  StatusCode code = StatusCode::kInternal;
  std::string field;
  std::string message;
};

using Problems = std::vector<Status>;

// A value, or the one reason there is none.
template <class T>
using Result = tl::expected<T, Status>;

inline tl::unexpected<Status> fail(StatusCode code, std::string field, std::string message) {
  return tl::unexpected<Status>(Status{code, std::move(field), std::move(message)});
}

}  // namespace tessera
