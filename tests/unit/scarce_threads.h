#pragma once

/// Refuses threads, as a system at its limit of processes does. For tests; one at a time.
class ScarceThreads {
 public:
  /// @param allowed  that may still be started; the next ones fail with EAGAIN while this object lives
  explicit ScarceThreads(int allowed);
  ~ScarceThreads();
  ScarceThreads(const ScarceThreads&) = delete;
};
