#include "tessera/cli/batch_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include "tessera/cli/child.h"
#include "tessera/cli/messages.h"
#include "tessera/cli/progress.h"
#include "tessera/cli/run_command.h"
#include "tessera/cli/signals.h"
#include "tessera/io/sha256.h"
#include "tessera/job/job_json.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFooter =
    "A line of the file is a job as --save-job writes it, with \"outputs\", a list of paths, and if wanted "
    "\"report\", "
    "a path.\nPictures are looked for beside the file first, then in the current folder. What became of each job is "
    "appended to the\nresults, a line each: line, sha256 of the job, status (that of tessera run), seconds, outputs, "
    "messages. With --resume\njobs that the results tell to be done are left out, if their outputs are there.";

Problems problem(const std::string& field, const std::string& message) {
  return {{StatusCode::kInvalidInput, field, message}};
}

// A line of the file.
struct Task {
  int line = 0;  // from 1
  std::string text;
};

// Tasks, one after the other; no line is held that is longer than a job may be.
class Tasks {
 public:
  Tasks(const std::string& path, int shard, int shards) : file_(path), shard_(shard), shards_(shards) {}

  bool opened() const { return file_.is_open(); }

  std::optional<Task> next() {
    while (read_line()) {
      if (task_.text.find_first_not_of(" \t\r") == std::string::npos) continue;
      if (jobs_++ % shards_ == shard_ - 1) return task_;
    }
    return {};
  }

 private:
  bool read_line() {
    ++task_.line;
    task_.text.clear();
    for (int c = file_.get(); c != '\n'; c = file_.get()) {
      if (c == std::ifstream::traits_type::eof()) return !task_.text.empty();
      if (task_.text.size() <= kMaxJobBytes) task_.text += static_cast<char>(c);
    }
    return true;
  }

  std::ifstream file_;
  int shard_, shards_, jobs_ = 0;
  Task task_;
};

struct Errand {
  Job job;
  Settings settings;
};

tl::expected<std::vector<OutputFile>, Problems> outputs_of(const Json& json) {
  const Problems wrong = problem("outputs", "is " + shown(json) + ", expected a list of paths");
  if (!json.is_array() || json.empty()) return tl::unexpected<Problems>(wrong);
  std::vector<OutputFile> outputs;
  for (const Json& path : json) {
    if (!path.is_string() || path == "-") return tl::unexpected<Problems>(wrong);
    outputs.push_back({path.get<std::string>(), ""});
  }
  return outputs;
}

// What a line asks for.
tl::expected<Errand, Problems> read_errand(const std::string& text, const Settings& settings) {
  auto parsed = parse_json(text);
  if (!parsed) return tl::unexpected<Problems>(Problems{std::move(parsed.error())});
  Json& json = *parsed;
  if (!json.is_object()) return tl::unexpected<Problems>(problem("", "is no object, expected a job"));
  auto outputs = outputs_of(json.value("outputs", Json()));
  if (!outputs) return tl::unexpected<Problems>(std::move(outputs.error()));
  Errand errand{{}, settings};
  errand.settings.outputs = *std::move(outputs);
  if (const Json report = json.value("report", Json("")); report.is_string())
    errand.settings.report = report;
  else
    return tl::unexpected<Problems>(problem("report", "is " + shown(report) + ", expected a path"));
  json.erase("outputs");
  json.erase("report");
  auto job = read_job(json.dump());
  if (!job) return tl::unexpected<Problems>(std::move(job.error()));
  errand.job = *std::move(job);
  return errand;
}

// In a process of its own.
int run_errand(const Task& task, const Batch& batch) {
  const auto errand = read_errand(task.text, batch.settings);
  if (!errand) return print_problems(errand.error());
  prepare(errand->settings);
  return run_and_write(errand->job, errand->settings, fs::path(batch.path).parent_path().string(),
                       ParametersFrom::kFile);
}

// The paths that a line names, as far as it can be read.
Json paths_of(const std::string& text) {
  const auto json = parse_json(text);
  return json && json->is_object() ? json->value("outputs", Json::array()) : Json::array();
}

// The file of results, which a batch appends to and goes on from.
class Results {
 public:
  explicit Results(std::string path) : path_(std::move(path)) {}

  // Takes in what an earlier batch has written; a last line that was not finished goes.
  void read() {
    std::ifstream file(path_, std::ios::binary);
    std::string line;
    std::uintmax_t whole = 0;
    while (std::getline(file, line) && !file.eof()) {
      whole += line.size() + 1;
      const Json entry = Json::parse(line, nullptr, false);
      if (!entry.is_object() || entry.value("status", Json()) != 0 || !all_there(entry.value("outputs", Json())))
        continue;
      if (const Json hash = entry.value("sha256", Json()); hash.is_string() && entry["line"].is_number_integer())
        done_[entry["line"].get<int>()] = hash;
    }
    std::error_code none;
    if (file.is_open()) fs::resize_file(path_, whole, none);
  }

  bool open(bool go_on) {
    file_.open(path_, std::ios::binary | (go_on ? std::ios::app : std::ios::trunc));
    return file_.is_open();
  }

  bool is_done(const Task& task) const {
    const auto found = done_.find(task.line);
    return found != done_.end() && found->second == sha256_hex(task.text);
  }

  bool add(const Task& task, const ChildEnd& end) {
    Json messages = Json::array();
    for (const std::string& line : end.messages) messages.push_back(line);
    const Json entry = {{"line", task.line},
                        {"sha256", sha256_hex(task.text)},
                        {"status", end.status},
                        {"seconds", std::round(end.seconds * 1e3) / 1e3},
                        {"outputs", paths_of(task.text)},
                        {"messages", messages}};
    file_ << entry.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n' << std::flush;
    return file_.good();
  }

 private:
  static bool all_there(const Json& paths) {
    return paths.is_array() && std::all_of(paths.begin(), paths.end(), [](const Json& path) {
             std::error_code none;
             return path.is_string() && fs::exists(path.get<std::string>(), none);
           });
  }

  std::string path_;
  std::map<int, std::string> done_;  // line -> its job's checksum
  std::ofstream file_;
};

std::string results_path(const Batch& batch) {
  if (!batch.results.empty()) return batch.results;
  const std::string part = batch.shards > 1 ? fmt::format(".{}-of-{}", batch.shard, batch.shards) : "";
  return fs::path(batch.path).replace_extension(part + ".results.jsonl").string();
}

// Tasks to processes, and what became of them to the results.
class Supervisor {
 public:
  Supervisor(const Batch& batch, Results& results) : batch_(batch), results_(results) {}

  // False where the results cannot be written; errno says why.
  bool run(Tasks& tasks, int count) {
    ProgressBar bar(batch_.settings.quiet ? ProgressMode::kNever : batch_.settings.progress);
    bar.stage("jobs");
    bool more = true;
    while (more || !children_.empty()) {
      while (more && stop_reason() == StopReason::kNone && static_cast<int>(children_.size()) < batch_.workers) {
        const auto task = tasks.next();
        more = task.has_value();
        if (!task) break;
        if (results_.is_done(*task))
          ++before_;
        else
          children_.push_back({*task, Child([&] { return run_errand(*task, batch_); })});
      }
      if (stop_reason() != StopReason::kNone) return true;  // children die with their owners
      if (children_.empty()) continue;
      const std::size_t ended = wait_for_one();
      if (ended == children_.size()) continue;  // a signal
      const ChildEnd end = children_[ended].child.end();
      if (!results_.add(children_[ended].task, end)) return false;
      count_in(children_[ended].task, end);
      children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(ended));
      bar.progress(static_cast<double>(before_ + done_ + failed_) / std::max(1, count));
    }
    return true;
  }

  int status() const { return first_failed_.second; }
  std::string summary() const {
    return fmt::format("jobs: {} done, {} failed", done_, failed_) +
           (before_ > 0 ? fmt::format(", {} done before", before_) : "");
  }

 private:
  struct Running {
    Task task;
    Child child;
  };

  std::size_t wait_for_one() {
    std::vector<Child*> children;
    for (Running& running : children_) children.push_back(&running.child);
    return wait_for(children);
  }

  void count_in(const Task& task, const ChildEnd& end) {
    ++(end.status == kExitDone ? done_ : failed_);
    if (end.status != kExitDone && (first_failed_.first == 0 || task.line < first_failed_.first))
      first_failed_ = {task.line, end.status};
  }

  const Batch& batch_;
  Results& results_;
  std::vector<Running> children_;
  int done_ = 0, failed_ = 0, before_ = 0;
  std::pair<int, int> first_failed_{0, kExitDone};  // line, status
};

}  // namespace

BatchFlags::BatchFlags(CLI::App& app)
    : app_(*app.add_subcommand("batch", "Run many saved jobs, each in a process of its own")),
      settings_(app_, "Run", setting_flags()) {
  app_.add_option("JOBS", batch_.path, "Jobs, one a line")->required()->type_name("FILE.jsonl");
  app_.add_option("--shard", shard_, "Only the i-th of n parts of the jobs")->type_name("i/n");
  app_.add_option("--jobs", batch_.workers, "So many at once; default 1")->check(CLI::Range(1, 1024));
  app_.add_option("--results", batch_.results, "What became of each job, a line each; default JOBS.results.jsonl")
      ->type_name("FILE.jsonl");
  app_.add_flag("--resume", batch_.resume, "Leave out what the results say is done");
  app_.add_flag("--quiet", batch_.settings.quiet, "Neither bar nor summary");
  app_.footer(kFooter);
}

Batch BatchFlags::read(Problems& problems) const {
  Batch batch = batch_;
  if (!shard_.empty()) {
    const char *begin = shard_.data(), *end = begin + shard_.size();
    const auto first = std::from_chars(begin, end, batch.shard);
    const bool slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
    const auto second = slash ? std::from_chars(first.ptr + 1, end, batch.shards) : first;
    if (!slash || second.ec != std::errc() || second.ptr != end || batch.shard < 1 || batch.shard > batch.shards)
      problems.push_back({StatusCode::kInvalidParameter, "--shard",
                          "is " + shown(shard_) + ", expected i/n with 1 <= i <= n, as 2/8"});
  }
  read_settings(settings_.given(), batch.settings, problems);
  settings_.name_flags(problems);
  return batch;
}

int run_batch(const Batch& batch) {
  Tasks counted(batch.path, batch.shard, batch.shards), tasks(batch.path, batch.shard, batch.shards);
  if (!tasks.opened() || fs::is_directory(batch.path)) return print_problems(problem(batch.path, "cannot be read"));
  int count = 0;
  while (counted.next()) ++count;
  const std::string path = results_path(batch);
  Results results(path);
  if (batch.resume) results.read();
  const auto unwritable = [&] {
    const std::string reason = std::generic_category().message(errno);
    return print_problems({{StatusCode::kUnwritable, path, "cannot be written: " + reason}});
  };
  if (!results.open(batch.resume)) return unwritable();
  Supervisor supervisor(batch, results);
  if (!supervisor.run(tasks, count)) return unwritable();
  if (stop_reason() != StopReason::kNone) {
    Status stopped = stop_status();
    stopped.message += "; " + supervisor.summary() + ", --resume goes on";
    return print_problems({stopped});
  }
  if (!batch.settings.quiet) print_message(supervisor.summary());
  return supervisor.status();
}

}  // namespace tessera
