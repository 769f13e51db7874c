#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <new>
#include <string_view>

#include "tessera/cli/command_line.h"
#include "tessera/cli/messages.h"
#include "tessera/cli/run_command.h"
#include "tessera/cli/saved_job.h"
#include "tessera/cli/signals.h"
#include "tessera/io/atomic_file.h"
#include "tessera/job/guarded.h"
#include "tessera/job/reference.h"

#ifdef __GLIBC__  // known once any header of its own has been read
#include <malloc.h>
#include <sys/mman.h>
#endif

namespace tessera {
namespace {

// Large buffers come and go at every step of a job. Given back to the system and asked for again each time, in pages
// of 4 KiB, they cost a quarter of the run.
void keep_freed_memory() {
#if defined(__GLIBC__) && !defined(__SANITIZE_THREAD__)  // whose own allocator takes half a second for the block
  // NOLINTBEGIN(concurrency-mt-unsafe): no other thread runs yet
  mallopt(M_MMAP_MAX, 0);  // large blocks come from the heap, too
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, 1 << 26);
  // NOLINTEND(concurrency-mt-unsafe)
  // The heap's beginning in huge pages: a block asked for and freed at once stays a part of it.
  constexpr std::size_t kBlock = 1024 << 20, kPage = 2 << 20;
  if (void* const block = std::malloc(kBlock)) {
    const auto first = (reinterpret_cast<std::uintptr_t>(block) + kPage - 1) / kPage * kPage;
    madvise(reinterpret_cast<void*>(first), kBlock - kPage, MADV_HUGEPAGE);  // a wish; without it all works as well
    std::free(block);
  }
#endif
}

int execute(const RunNewJob& command) {
  prepare(command.settings);
  return run_and_write(command.job, command.settings, "", ParametersFrom::kFlags);
}

int execute(const RunSavedJob& command) {
  prepare(command.settings);
  const auto job = load_job(command.path, command.changes);
  if (!job) {
    return print_problems(stop_reason() == StopReason::kNone ? job.error() : Problems{stop_status()});
  }
  return run_and_write(*job, command.settings, std::filesystem::path(command.path).parent_path().string(),
                       ParametersFrom::kFile);
}

int print_to_stdout(const std::string& text) {
  AtomicFiles output;
  auto done = output.add("-", text).and_then([&] { return output.commit(); });
  return done ? kExitDone : print_problems({std::move(done.error())});
}

int execute(const PrintSchema& command) {
  if (command.markdown) return print_to_stdout(parameter_reference());
  if (command.technique.empty()) return print_to_stdout(job_schema().dump(2) + "\n");
  std::vector<std::string> names;
  for (const Technique& technique : techniques()) {
    if (command.technique == technique.name || command.technique == technique.command) {
      return print_to_stdout(params_schema(technique).dump(2) + "\n");
    }
    names.emplace_back(technique.name);
  }
  return print_problems(
      {{StatusCode::kInvalidParameter, command.technique, "is no technique, expected " + either_of(names)}});
}

int execute(const AskJob& command) {
  prepare(command.settings);
  const auto answer = ask_job(command.job, *command.question, command.settings);
  return answer ? print_to_stdout(*answer) : print_problems(answer.error());
}

int execute(const Batch& command) { return run_batch(command); }

int execute(const Measure& command) { return run_measure(command); }

int execute(const View& command) { return run_view(command); }

int execute(const FitCommand& command) { return run_fit(command); }

int execute(const PrintText& command) { return print_to_stdout(command.text); }

int main_of(int argc, const char* const* argv) {
  keep_freed_memory();
  install_signal_handlers();
  const auto command = parse_command_line(argc, argv);
  if (!command) return command.error();
  return std::visit([](const auto& c) { return execute(c); }, *command);
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv) {
  try {
    return tessera::main_of(argc, argv);
  } catch (const std::bad_alloc&) {
    return tessera::print_problems({{tessera::StatusCode::kInternal, "", tessera::kOutOfMemory}});
  } catch (const std::exception& error) {
    // OpenCV's threads begin when there is something to do.
    if (std::string_view(error.what()).find("pthread_create") != std::string_view::npos)
      return tessera::print_problems({{tessera::StatusCode::kInternal, "",
                                       std::string("threads cannot be started (") + error.what() +
                                           "); --threads 1 needs none, and less memory"}});
    return tessera::print_problems(
        {{tessera::StatusCode::kInternal, "", std::string("a fault of ours: ") + error.what()}});
  }
}
