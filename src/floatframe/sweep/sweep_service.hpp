#pragma once
// What a worker process does for a study, and the texts in which it is asked and answers.
#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/sweep/sweep_run.hpp"
#include "floatframe/sweep/worker_guard.hpp"

namespace floatframe {

struct ServiceRequest {
  enum class What {
    open,   ///< find out what the names of the study stand for
    check,  ///< read a run and check its values
    build,  ///< build the model of a run
    files,  ///< fingerprint of the files that the first run reads
    run     ///< run it
  } what = What::open;
  std::size_t run = 0;
};
std::string encode(const ServiceRequest& request);

struct ServiceAnswer {
  enum class Kind {
    done,      ///< `text`: the line of a run or the fingerprint
    errors,    ///< of the input
    given_up,  ///< because the study ends
    error      ///< `text`: what must end the study
  } kind = Kind::done;
  std::string text;
  std::vector<ErrorEntry> errors;
  std::map<std::string, std::string> files;  ///< read since the worker's last answer: fingerprints
};
std::string encode(const ServiceAnswer& answer);
/// False for anything that `encode` did not make.
bool decode(const std::string& text, ServiceAnswer& answer);

class SweepService {
 public:
  /// Both must outlive the service.
  SweepService(const SweepOptions& options, const std::atomic<bool>& give_up)
      : options_(options), give_up_(give_up) {}
  /// The answer to a request, both encoded.
  std::string serve(const std::string& request, WorkerState& state);

 private:
  std::string answer(const ServiceRequest& request, WorkerState& state);

  const SweepOptions& options_;
  const std::atomic<bool>& give_up_;
  std::unique_ptr<SweepRunner> runner_;            // made by the first request
  std::map<std::string, std::string> sent_files_;  // with former answers
};

}  // namespace floatframe
