#include "tessera/cli/saved_job.h"

#include <algorithm>
#include <utility>

#include "tessera/cli/flags.h"
#include "tessera/io/file.h"
#include "tessera/job/job_json.h"
#include "tessera/job/techniques.h"

namespace tessera {
namespace {

const Parameter* find_parameter(const std::vector<Parameter>& all, const std::string& key) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.info.key == key; });
  return found == all.end() ? nullptr : &*found;
}

void set_seed(const Json& value, Job& job, Problems& problems) {
  if (auto trouble = complaint({kSeedInfo, ParameterKind::kInteger, {}, {}}, value)) {
    problems.push_back({StatusCode::kInvalidParameter, "seed", *std::move(trouble)});
  } else {
    job.seed = value.get<std::uint64_t>();
  }
}

// Parameters are set together, so that their order does not matter where they depend on each other.
void apply_changes(const std::vector<std::string>& changes, Job& job, Problems& problems) {
  const Technique& technique = technique_of(job.params);
  const std::vector<Parameter> parameters = parameters_of(job.params);
  Json given = Json::object();
  for (const std::string& change : changes) {
    const std::size_t equals = change.find('=');
    if (equals == std::string::npos) {
      problems.push_back({StatusCode::kInvalidParameter, "--set", "is " + shown(change) + ", expected key=value"});
      continue;
    }
    const std::string key = change.substr(0, equals), text = change.substr(equals + 1);
    const Parameter* parameter = find_parameter(parameters, key);
    if (key == kSeedInfo.key) {
      set_seed(parse_value({kSeedInfo, ParameterKind::kInteger, {}, {}}, text), job, problems);
    } else if (role_of(technique, key)) {
      job.inputs[key] = text;
    } else {
      given[key] = parameter ? parse_value(*parameter, text) : Json(text);
    }
  }
  read_params(given, job.params, problems);
  for (Status& problem : problems) problem.message += " (--set)";
}

}  // namespace

tl::expected<Job, Problems> load_job(const std::string& path, const std::vector<std::string>& changes) {
  auto text = read_file(path);
  if (!text) return tl::unexpected<Problems>(Problems{std::move(text.error())});
  return read_saved_job(*text, path, changes);
}

tl::expected<Job, Problems> read_saved_job(const std::string& text, const std::string& path,
                                           const std::vector<std::string>& changes) {
  auto job = read_job(text);
  if (!job) {
    for (Status& problem : job.error()) {
      problem.field = problem.field.empty() ? input_name(path) : input_name(path) + ": " + problem.field;
    }
    return job;
  }
  Problems problems;
  apply_changes(changes, *job, problems);
  if (!problems.empty()) return tl::unexpected<Problems>(std::move(problems));
  return job;
}

}  // namespace tessera
