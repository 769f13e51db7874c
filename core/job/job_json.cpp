#include "tessera/job/job_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "tessera/job/techniques.h"

namespace tessera {
namespace {

// Deeper than any job, found without parsing: a parser's own recursion is bounded by its stack only.
bool nests_too_deep(std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxJobDepth) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

// "line 3, column 7" of a byte offset that counts from 1.
std::string place_in(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte > 0 ? byte - 1 : 0);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return fmt::format("line {}, column {}", line, before.size() - start + 1);
}

// Sees keys as they are parsed, since of equal ones the last would win unseen.
class RepeatedKeys {
 public:
  void operator()(Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start) open_.emplace_back();
    if (event == Event::object_end) open_.pop_back();
    if (event == Event::key && !open_.back().insert(parsed.get<std::string>()).second) first_ = parsed;
  }
  const Json& found() const { return first_; }  // null: none

 private:
  std::vector<std::set<std::string>> open_;
  Json first_;
};

// Reads the members of a job; every problem is added to `problems`.
class JobReader {
 public:
  JobReader(const Json& json, Problems& problems) : json_(json), problems_(problems) {}

  Job read() {
    check_members();
    check_version();
    Job job;
    read_seed(job);
    if (const Technique* technique = read_technique()) {
      job.params = technique->defaults;
      if (json_.contains("params")) read_params(json_["params"], job.params, problems_);
      if (json_.contains("inputs")) read_inputs(*technique, job);
    }
    return job;
  }

 private:
  void complain(std::string field, std::string message) {
    problems_.push_back({StatusCode::kInvalidParameter, std::move(field), std::move(message)});
  }

  void check_members() {
    static const std::vector<std::string> known = {"schemaVersion", "technique", "seed", "params", "inputs"};
    for (const auto& [key, value] : json_.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        complain(shown_key(key), "is no member of a job, expected " + either_of(known));
      }
    }
  }

  void check_version() {
    if (!json_.contains("schemaVersion")) {
      complain("schemaVersion", fmt::format("is missing, expected {}", kSchemaVersion));
    } else if (json_["schemaVersion"] != kSchemaVersion) {
      complain("schemaVersion", fmt::format("is {}, expected {}", shown(json_["schemaVersion"]), kSchemaVersion));
    }
  }

  void read_seed(Job& job) {
    if (!json_.contains("seed")) return;
    const Json& value = json_["seed"];
    if (auto trouble = complaint({kSeedInfo, ParameterKind::kInteger, {}, {}}, value)) {
      complain("seed", *std::move(trouble));
    } else {
      job.seed = value.get<std::uint64_t>();
    }
  }

  const Technique* read_technique() {
    std::vector<std::string> names;
    for (const Technique& technique : techniques()) names.emplace_back(technique.name);
    if (!json_.contains("technique")) {
      complain("technique", "is missing, expected " + either_of(names));
      return nullptr;
    }
    const Json& value = json_["technique"];
    const Technique* found = value.is_string() ? find_technique(value.get<std::string>()) : nullptr;
    if (!found) complain("technique", fmt::format("is {}, expected {}", shown(value), either_of(names)));
    return found;
  }

  void read_inputs(const Technique& technique, Job& job) {
    const Json& inputs = json_["inputs"];
    if (!inputs.is_object()) {
      complain("inputs", fmt::format("is {}, expected an object", shown(inputs)));
      return;
    }
    for (const auto& [role, value] : inputs.items()) {
      if (!role_of(technique, role)) {
        complain(shown_key(role),
                 fmt::format("is no input of {}, expected {}", technique.name, role_names(technique)));
      } else if (!value.is_string()) {
        complain(role, fmt::format("is {}, expected the path of a picture", shown(value)));
      } else {
        job.inputs[role] = value.get<std::string>();
      }
    }
  }

  const Json& json_;
  Problems& problems_;
};

}  // namespace

Json job_to_json(const Job& job) {
  return {{"schemaVersion", kSchemaVersion},
          {"technique", technique_of(job.params).name},
          {"seed", job.seed},
          {"params", write_params(job.params)},
          {"inputs", job.inputs}};
}

std::string job_to_text(const Job& job, Layout layout) {
  // A path need not be UTF-8, JSON must.
  return job_to_json(job).dump(layout == Layout::kIndented ? 2 : -1, ' ', false, Json::error_handler_t::replace);
}

Result<Json> parse_json(std::string_view text) {
  constexpr auto kCode = StatusCode::kInvalidInput;
  if (text.size() > kMaxJobBytes) {
    return fail(kCode, "", fmt::format("is {} bytes long, expected a job of at most {}", text.size(), kMaxJobBytes));
  }
  if (nests_too_deep(text)) {
    return fail(kCode, "", fmt::format("nests deeper than {} levels, expected a job", kMaxJobDepth));
  }
  RepeatedKeys repeated;
  try {
    Json json = Json::parse(text, [&](int, Json::parse_event_t event, Json& parsed) {
      repeated(event, parsed);
      return true;
    });
    if (repeated.found().is_null()) return json;
  } catch (const Json::parse_error& error) {
    return fail(kCode, "", fmt::format("is not JSON at {}, expected a job", place_in(text, error.byte)));
  } catch (const Json::out_of_range&) {
    return fail(kCode, "", "has a number too large for JSON");
  }
  return fail(kCode, "", fmt::format("has {} twice in one object", shown(repeated.found())));
}

tl::expected<Job, Problems> read_job(std::string_view text) {
  const auto refuse = [](Status status) { return tl::unexpected<Problems>(Problems{std::move(status)}); };
  std::string extracted;
  const std::size_t start = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (start != std::string_view::npos && text[start] == '<') {
    auto found = extract_job_from_svg(text);
    if (!found) return refuse(std::move(found.error()));
    extracted = *std::move(found);
    text = extracted;
  }
  auto json = parse_json(text);
  if (!json) return refuse(std::move(json.error()));
  if (!json->is_object()) {
    return refuse({StatusCode::kInvalidInput, "", fmt::format("is {}, expected a job", shown(*json))});
  }
  Problems problems;
  Job job = JobReader(*json, problems).read();
  if (!problems.empty()) return tl::unexpected<Problems>(std::move(problems));
  return job;
}

}  // namespace tessera
