#include "tessera/cli/outputs.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "tessera/io/sha256.h"
#include "tessera/job/job_json.h"
#include "tessera/job/techniques.h"

namespace tessera {
namespace {

bool contains(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return text;
}

// The kind in a name: "svg" of "a/b.SVG", "bom.csv" of "a.bom.csv" where the technique has such a kind; empty where
// there is none.
std::string extension_of(const std::string& path, const Technique& technique) {
  const std::string name = lower(std::filesystem::path(path).filename().string());
  for (std::size_t dot = name.find('.', 1); dot != std::string::npos; dot = name.find('.', dot + 1))
    if (contains(technique.formats, name.substr(dot + 1))) return name.substr(dot + 1);
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  return extension.empty() ? "" : extension.substr(1);
}

// Empty, or what is wrong with a kind.
std::string format_trouble(const std::string& format, const Technique& technique) {
  const std::string expected = either_of(technique.formats);
  if (contains(technique.formats, format)) return "";
  if (format.empty()) return "has no extension, expected " + expected + " (--format)";
  return "cannot be of kind " + format + ", expected " + expected;
}

void check_repetition(const Settings& settings, Problems& problems) {
  std::set<std::string> seen;
  std::vector<std::string> paths;
  for (const OutputFile& output : settings.outputs) paths.push_back(output.path);
  for (const std::string& path : {settings.report, settings.save_job}) {
    if (!path.empty()) paths.push_back(path);
  }
  for (const std::string& path : paths) {
    if (!seen.insert(path).second) {
      problems.push_back({StatusCode::kInvalidParameter, path, "is named for two outputs, expected one"});
    }
  }
}

std::string file_name_in(const std::string& folder, const std::string& artifact) {
  return (std::filesystem::path(folder) / std::filesystem::path(artifact).filename()).string();
}

}  // namespace

std::vector<std::string> plan_formats(const Settings& settings, const Job& job, Problems& problems) {
  const Technique& technique = technique_of(job.params);
  const auto refuse = [&](const std::string& field, std::string message) {
    problems.push_back({StatusCode::kInvalidParameter, field, std::move(message)});
  };
  if (settings.outputs.empty() && settings.plots.empty() && settings.report.empty()) {
    refuse("", "there is no output, expected -o FILE");
  }
  std::vector<std::string> formats;
  for (const auto& [path, format] : settings.outputs) {
    const std::string extension = format.empty() ? extension_of(path, technique) : format;
    formats.push_back(extension.empty() ? settings.format : extension);
    if (std::string trouble = format_trouble(formats.back(), technique); !trouble.empty()) {
      refuse(path, std::move(trouble));
    }
  }
  check_repetition(settings, problems);
  return formats;
}

Result<std::vector<WrittenFile>> write_outputs(const Settings& settings, const Job& job, const JobResult& result,
                                               AtomicFiles& files) {
  std::vector<WrittenFile> written;
  const auto write = [&](const std::string& path, const std::string& bytes) {
    written.push_back({path, bytes.size(), settings.report.empty() ? "" : sha256_hex(bytes)});
    return files.add(path, bytes);
  };
  if (!settings.plots.empty()) {
    if (auto made = files.add_folder(settings.plots); !made) return tl::unexpected<Status>(std::move(made.error()));
  }
  // The artifacts are those of the outputs, one each, then the plots.
  for (std::size_t i = 0; i < result.artifacts.size(); ++i) {
    const Artifact& artifact = result.artifacts[i];
    const std::string path =
        i < settings.outputs.size() ? settings.outputs[i].path : file_name_in(settings.plots, artifact.name);
    if (auto done = write(path, artifact.bytes); !done) return tl::unexpected<Status>(std::move(done.error()));
  }
  if (!settings.save_job.empty()) {
    auto done = write(settings.save_job, job_to_text(job, Layout::kIndented) + "\n");
    if (!done) return tl::unexpected<Status>(std::move(done.error()));
  }
  return written;
}

}  // namespace tessera
