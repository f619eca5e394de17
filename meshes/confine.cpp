#include "meshes/confine.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>

namespace pintle {

namespace {

// From linux/landlock.h, which older systems lack; the numbers are fixed.
constexpr long landlock_create = 444, landlock_add = 445, landlock_restrict = 446;
constexpr std::uint64_t read_file = 1 << 2, read_folder = 1 << 3;
struct Ruleset {
  std::uint64_t files;
};
struct [[gnu::packed]] Below {
  std::uint64_t allowed;
  std::int32_t folder;
};

/// All file access rights known to this version of Landlock.
std::uint64_t rights_of(long version) {
  const int count = version >= 5 ? 16 : version >= 3 ? 15 : version >= 2 ? 14 : 13;
  return (std::uint64_t{1} << count) - 1;
}

bool contain_files(const std::vector<std::string>& folders) {
  const long version = syscall(landlock_create, nullptr, 0, 1);
  if (version < 1) return false;
  const Ruleset handled{rights_of(version)};
  const int rules = static_cast<int>(syscall(landlock_create, &handled, sizeof handled, 0));
  if (rules < 0) return false;
  for (const std::string& folder : folders) {
    const int fd = open(folder.c_str(), O_PATH | O_CLOEXEC | O_DIRECTORY);
    if (fd < 0) continue;
    const Below below{read_file | read_folder, fd};
    syscall(landlock_add, rules, 1, &below, 0);
    close(fd);
  }
  const bool done = syscall(landlock_restrict, rules, 0) == 0;
  close(rules);
  return done;
}

#if defined(__x86_64__)
constexpr std::uint32_t machine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t machine = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t machine = 0;
#endif

constexpr long forbidden[]{SYS_execve,
                           SYS_execveat,
#ifdef SYS_fork
                           SYS_fork,
                           SYS_vfork,
#endif
                           SYS_socket,
                           SYS_socketpair,
                           SYS_connect,
                           SYS_bind,
                           SYS_listen,
                           SYS_accept,
                           SYS_accept4,
                           SYS_ptrace,
                           SYS_process_vm_readv,
                           SYS_process_vm_writev,
                           SYS_kill,
                           SYS_tkill,
                           SYS_open_by_handle_at,
                           SYS_mount,
                           SYS_umount2,
                           SYS_pivot_root,
                           SYS_chroot,
                           SYS_unshare,
                           SYS_setns,
                           SYS_bpf,
                           SYS_perf_event_open,
                           SYS_userfaultfd,
                           SYS_keyctl,
                           SYS_add_key,
                           SYS_request_key,
                           SYS_io_uring_setup,
                           SYS_init_module,
                           SYS_finit_module,
                           SYS_kexec_load,
                           SYS_shmget,
                           SYS_msgget,
                           SYS_semget};

sock_filter load(std::size_t offset) { return {BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<std::uint32_t>(offset)}; }
sock_filter answer(std::uint32_t action) { return {BPF_RET | BPF_K, 0, 0, action}; }
/// Executes the next instruction if the test holds, else the one after it.
sock_filter if_true(std::uint16_t test, std::uint32_t value) { return {static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), 0, 1, value}; }
/// Executes the next instruction unless the test holds.
sock_filter unless(std::uint16_t test, std::uint32_t value) { return {static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), 1, 0, value}; }

bool filter_calls() {
  if (machine == 0) return false;
  const auto kill = answer(SECCOMP_RET_KILL_PROCESS);
  std::vector<sock_filter> program{load(offsetof(seccomp_data, arch)), unless(BPF_JEQ, machine),     kill,
                                   load(offsetof(seccomp_data, nr)),   if_true(BPF_JGE, 0x40000000), kill};
  for (const long call : forbidden) program.insert(program.end(), {if_true(BPF_JEQ, static_cast<std::uint32_t>(call)), kill});
  // Threads are allowed. clone3 passes its flags by pointer, where they cannot be checked; without it the C library uses clone.
  program.insert(program.end(), {if_true(BPF_JEQ, SYS_clone3), answer(SECCOMP_RET_ERRNO | ENOSYS)});
  sock_filter not_clone = if_true(BPF_JEQ, SYS_clone);
  not_clone.jf = 3;
  program.insert(program.end(),
                 {not_clone, load(offsetof(seccomp_data, args)), unless(BPF_JSET, CLONE_THREAD), kill, answer(SECCOMP_RET_ALLOW)});
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

}  // namespace

bool confine(const std::vector<std::string>& folders) {
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  const bool files = contain_files(folders), calls = filter_calls();
  return files && calls;
}

}  // namespace pintle
