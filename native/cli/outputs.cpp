#include "tessera/cli/outputs.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "tessera/cli/signals.h"
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

// What an output is to be; a technique of many files puts them into a folder, which needs no extension.
std::string kind_of(const OutputFile& output, const Settings& settings, const Technique& technique) {
  if (!output.format.empty()) return output.format;
  const std::string extension = extension_of(output.path, technique);
  const bool is_kind = contains(technique.formats, extension);
  if (contains(technique.formats, "folder") && !is_kind && output.path != "-" && settings.format.empty())
    return "folder";
  return extension.empty() ? settings.format : extension;
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

bool is_in_folder(const Artifact& artifact) { return artifact.name.compare(0, 7, "folder/") == 0; }

// Cut files and previews of an earlier run, which could be taken for this one's.
std::vector<std::string> numbered_files_in(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const auto ends_with = [&](std::string_view end) {
      return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
    };
    const bool is_panel = name.compare(0, 6, "panel-") == 0 &&
                          (ends_with(".cut.svg") || ends_with(".cut.dxf") || ends_with(".preview.png"));
    const bool is_preview = name.size() > 12 && name.compare(0, 8, "preview-") == 0 && ends_with(".png") &&
                            name.find_first_not_of("0123456789", 8) == name.size() - 4;
    if (is_panel || is_preview) found.push_back(file_name_in(folder, name));
  }
  return found;
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
  for (const OutputFile& output : settings.outputs) {
    formats.push_back(kind_of(output, settings, technique));
    std::string trouble = format_trouble(formats.back(), technique);
    if (trouble.empty() && formats.back() == "folder" && output.path == "-") trouble = "cannot be a folder";
    if (!trouble.empty()) refuse(output.path, std::move(trouble));
  }
  check_repetition(settings, problems);
  return formats;
}

std::vector<std::string> report_paths(const Settings& settings, const std::vector<std::string>& formats) {
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < formats.size(); ++i)
    if (formats[i] == "folder") paths.push_back(file_name_in(settings.outputs[i].path, "report.json"));
  if (!settings.report.empty()) paths.push_back(settings.report);
  return paths;
}

std::string checkpoint_path(const Settings& settings, const std::vector<std::string>& formats) {
  const auto folder = std::find(formats.begin(), formats.end(), "folder");
  if (folder == formats.end()) return "";
  std::string path = settings.outputs[static_cast<std::size_t>(folder - formats.begin())].path;
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path + ".checkpoint";
}

Result<std::vector<WrittenFile>> write_outputs(const Settings& settings, const std::vector<std::string>& formats,
                                               const Job& job, const JobResult& result, AtomicFiles& files) {
  std::vector<WrittenFile> written;
  const bool with_checksums = !report_paths(settings, formats).empty();
  const auto write = [&](const std::string& path, const std::string& bytes) -> Result<void> {
    if (stop_reason() != StopReason::kNone) return tl::unexpected<Status>(stop_status());
    written.push_back({path, bytes.size(), with_checksums ? sha256_hex(bytes) : ""});
    return files.add(path, bytes);
  };
  if (!settings.plots.empty()) {
    if (auto made = files.add_folder(settings.plots); !made) return tl::unexpected<Status>(std::move(made.error()));
  }
  // The artifacts are those of the outputs, one each and of a folder many, then the plots.
  auto artifact = result.artifacts.begin();
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const std::string& path = settings.outputs[i].path;
    if (formats[i] != "folder") {
      if (auto done = write(path, (artifact++)->bytes); !done) return tl::unexpected<Status>(std::move(done.error()));
      continue;
    }
    if (auto made = files.add_folder(path); !made) return tl::unexpected<Status>(std::move(made.error()));
    std::set<std::string> names;
    for (; artifact != result.artifacts.end() && is_in_folder(*artifact); ++artifact) {
      const std::string file = file_name_in(path, artifact->name);
      if (!names.insert(file).second) break;  // the next output is a folder, too
      if (auto done = write(file, artifact->bytes); !done) return tl::unexpected<Status>(std::move(done.error()));
    }
    for (const std::string& old : numbered_files_in(path))
      if (!names.count(old)) files.remove(old);
  }
  for (; artifact != result.artifacts.end(); ++artifact) {
    auto done = write(file_name_in(settings.plots, artifact->name), artifact->bytes);
    if (!done) return tl::unexpected<Status>(std::move(done.error()));
  }
  if (auto saved = save_job(settings, job, files, written); !saved)
    return tl::unexpected<Status>(std::move(saved.error()));
  return written;
}

Result<void> save_job(const Settings& settings, const Job& job, AtomicFiles& files,
                      std::vector<WrittenFile>& written) {
  if (settings.save_job.empty()) return {};
  const std::string bytes = job_to_text(job, Layout::kIndented) + "\n";
  const bool with_checksum = !settings.report.empty();
  written.push_back({settings.save_job, bytes.size(), with_checksum ? sha256_hex(bytes) : ""});
  return files.add(settings.save_job, bytes);
}

}  // namespace tessera
