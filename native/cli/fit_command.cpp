#include "tessera/cli/fit_command.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "tessera/cli/messages.h"
#include "tessera/cli/signals.h"
#include "tessera/io/atomic_file.h"
#include "tessera/io/file.h"
#include "tessera/io/picture.h"
#include "tessera/io/sha256.h"
#include "tessera/job/fit.h"
#include "tessera/job/job_json.h"

namespace tessera {
namespace {

Result<Fit> fit_bytes(const std::string& bytes, const FitCommand& command) {
  auto picture =
      decode_picture({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, command.max_pixels);
  if (!picture) return tl::unexpected<Status>(std::move(picture.error()));
  RunContext context;
  context.stop = &stop_flag();
  return fit_pattern(picture->view(), command.seed, context);
}

std::string report_of(const FitCommand& command, const std::string& bytes, const Fit& fit) {
  Json report = {{"tessera", TESSERA_VERSION},
                 {"technique", "fit"},
                 {"seed", command.seed},
                 {"inputs", {{{"path", command.path}, {"sha256", sha256_hex(bytes)}}}}};
  report.update(fit_to_json(fit, command.seed));
  return report.dump(1) + "\n";
}

Result<void> write(const FitCommand& command, const std::string& bytes, const Fit& fit) {
  AtomicFiles files;
  if (!command.output.empty()) {
    const std::string job = job_to_text(job_of(fit, command.seed), Layout::kIndented);
    if (auto done = files.add(command.output, job); !done) return done;
  }
  const std::string report = command.output.empty() && command.report.empty() ? "-" : command.report;
  if (!report.empty())
    if (auto done = files.add(report, report_of(command, bytes, fit)); !done) return done;
  if (stop_reason() != StopReason::kNone) return tl::unexpected<Status>(stop_status());
  return files.commit();
}

}  // namespace

CLI::App& add_fit_command(CLI::App& app, FitCommand& fit) {
  CLI::App& command = *app.add_subcommand("fit", "The model of random geometry that a picture looks like, as a job");
  command.add_option("PICTURE", fit.path, "A picture of cells of a few colours")->required()->type_name("FILE");
  command
      .add_option("-o,--output", fit.output, "Where the job goes that generates more of the same, for tessera run")
      ->type_name("FILE.json");
  command.add_option("--report", fit.report, "Write how well each model explains the picture, as JSON")
      ->type_name("FILE");
  command.add_option("--seed", fit.seed, "Start of the random numbers; default 1")->type_name("N");
  command.add_option("--max-pixels", fit.max_pixels, "Larger pictures are refused; default 100000000")
      ->type_name("N");
  command.footer("Without an output the report goes to standard output.");
  return command;
}

int run_fit(const FitCommand& command) {
  auto bytes = read_file(command.path);
  if (!bytes) return print_problems({std::move(bytes.error())});
  auto fit = fit_bytes(*bytes, command);
  if (!fit && fit.error().field.empty()) fit.error().field = input_name(command.path);
  if (!fit) return print_problems({std::move(fit.error())});
  auto done = write(command, *bytes, *fit);
  return done ? kExitDone : print_problems({std::move(done.error())});
}

}  // namespace tessera
