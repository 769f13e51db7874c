// A part of every program that is built for ThreadSanitizer: OpenCV's loops on threads that it sees.
//
// OpenCV runs cv::parallel_for_ on TBB. That is not instrumented, so ThreadSanitizer does not see it wait for its
// threads and takes whatever a loop leaves behind for a race. Suppressing what has TBB on its stack would silence all
// our loops, true races included; here threads begin and end where it sees them, so that nothing need be suppressed.
#include <algorithm>
#include <memory>
#include <opencv2/core/parallel/parallel_backend.hpp>
#include <thread>
#include <vector>

namespace {

thread_local int t_number = 0;

class SeenThreads : public cv::parallel::ParallelForAPI {
 public:
  void parallel_for(int tasks, FN_parallel_for_body_cb_t body, void* data) override {
    const int count = std::min(threads_, tasks);
    const auto work = [&](int number) {
      const int outer = t_number;
      t_number = number;
      // By turns, so that neighbours never share a thread. If each took what is next, the first would be done with a
      // short loop before the others begin, and races in it would not be seen.
      for (int i = number; i < tasks; i += count) body(i, i + 1, data);
      t_number = outer;
    };
    std::vector<std::thread> others;
    for (int number = 1; number < count; ++number) others.emplace_back(work, number);
    work(0);
    for (std::thread& thread : others) thread.join();
  }

  int getThreadNum() const override { return t_number; }
  int getNumThreads() const override { return threads_; }
  int setNumThreads(int threads) override {
    const int before = threads_;
    threads_ = threads > 0 ? threads : kThreads;
    return before;
  }
  const char* getName() const override { return "threads that ThreadSanitizer sees"; }

 private:
  static constexpr int kThreads = 4;  // on any machine: with one processor there are races, too
  int threads_ = kThreads;
};

[[maybe_unused]] const bool kInUse = [] {
  cv::parallel::setParallelForBackend(std::make_shared<SeenThreads>(), false);
  return true;
}();

}  // namespace
