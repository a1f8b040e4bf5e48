#pragma once
// The requests that a worker process serves for a study, and their encoding.
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
    open,   ///< resolve the names of the study
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
    done,       ///< `text`: line of a run or fingerprint
    errors,     ///< errors of the input
    cancelled,  ///< cancelled because the study ends
    error       ///< `text`: an error that ends the study
  } kind = Kind::done;
  std::string text;
  std::vector<ErrorEntry> errors;
  std::map<std::string, std::string> files;  ///< files read since the last answer: fingerprints
};
std::string encode(const ServiceAnswer& answer);
/// False for text that `encode` did not produce.
bool decode(const std::string& text, ServiceAnswer& answer);

class SweepService {
 public:
  /// Both must outlive the service.
  SweepService(const SweepOptions& options, const std::atomic<bool>& give_up)
      : options_(options), cancel_(give_up) {}
  /// The answer to a request, both encoded.
  std::string serve(const std::string& request, WorkerState& state);

 private:
  std::string answer(const ServiceRequest& request, WorkerState& state);

  const SweepOptions& options_;
  const std::atomic<bool>& cancel_;
  std::unique_ptr<SweepRunner> runner_;            // created by the first request
  std::map<std::string, std::string> sent_files_;  // sent with earlier answers
};

}  // namespace floatframe
