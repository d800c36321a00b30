// Functions that the C++ runtime, the headers of today and we ourselves use, and that glibc got after 2.17.
// They are linked into the library and seen by nobody else, so that it loads in old systems (make_stubs.py).
#undef _FILE_OFFSET_BITS // would make stat64 of stat
#include <dlfcn.h>
#include <elf.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

extern "C" {

// Before glibc 2.33 the headers made these from __xstat and its kin, which every glibc still has.
#ifdef __i386__
enum { stat_version = 3 };
#elif defined(__x86_64__)
enum { stat_version = 1 };
#else
enum { stat_version = 0 };
#endif
int __xstat(int version, const char* path, struct stat* status);
int __lxstat(int version, const char* path, struct stat* status);
int __fxstat(int version, int descriptor, struct stat* status);
int __fxstatat(int version, int folder, const char* path, struct stat* status, int flags);
int __xstat64(int version, const char* path, struct stat64* status);
int __lxstat64(int version, const char* path, struct stat64* status);
int __fxstat64(int version, int descriptor, struct stat64* status);
int __fxstatat64(int version, int folder, const char* path, struct stat64* status, int flags);

int stat(const char* path, struct stat* status) noexcept { return __xstat(stat_version, path, status); }
int lstat(const char* path, struct stat* status) noexcept { return __lxstat(stat_version, path, status); }
int fstat(int descriptor, struct stat* status) noexcept { return __fxstat(stat_version, descriptor, status); }
int fstatat(int folder, const char* path, struct stat* status, int flags) noexcept {
    return __fxstatat(stat_version, folder, path, status, flags);
}
int stat64(const char* path, struct stat64* status) noexcept { return __xstat64(stat_version, path, status); }
int lstat64(const char* path, struct stat64* status) noexcept {
    return __lxstat64(stat_version, path, status);
}
int fstat64(int descriptor, struct stat64* status) noexcept {
    return __fxstat64(stat_version, descriptor, status);
}
int fstatat64(int folder, const char* path, struct stat64* status, int flags) noexcept {
    return __fxstatat64(stat_version, folder, path, status, flags);
}

#ifdef __i386__
// glibc 2.28, where files may be large.
int fcntl64(int descriptor, int command, ...) {
    va_list rest;
    va_start(rest, command);
    const long argument = va_arg(rest, long); // an int, a long or a pointer
    va_end(rest);
    return static_cast<int>(syscall(SYS_fcntl64, descriptor, command, argument));
}
#endif

// glibc 2.32. False is right for every program: the C++ runtime then counts references atomically.
char __libc_single_threaded = 0;

// glibc 2.25 and 2.36, behind std::random_device.
int getentropy(void* bytes, size_t count) {
    auto* at = static_cast<char*>(bytes);
    int source = -1;
    for (size_t done = 0; done < count;) {
        long got = source < 0 ? syscall(SYS_getrandom, at + done, count - done, 0)
                              : read(source, at + done, count - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0 && source < 0 && errno == ENOSYS &&
            (source = open("/dev/urandom", O_RDONLY | O_CLOEXEC)) >= 0)
            continue;
        if (got <= 0) {
            if (source >= 0) close(source);
            errno = EIO;
            return -1;
        }
        done += static_cast<size_t>(got);
    }
    if (source >= 0) close(source);
    return 0;
}

uint32_t arc4random() noexcept {
    uint32_t value = 0;
    if (getentropy(&value, sizeof value) != 0) {
        timespec now{};
        clock_gettime(CLOCK_MONOTONIC, &now);
        value = static_cast<uint32_t>(now.tv_nsec) * 2654435761U ^ static_cast<uint32_t>(getpid());
    }
    return value;
}

// glibc 2.30, behind waits of std::condition_variable for a time of the steady clock.
int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const timespec* until) {
    timespec now{};
    timespec end = *until;
    if (clock != CLOCK_REALTIME) {
        clock_gettime(clock, &now);
        const long long left = (until->tv_sec - now.tv_sec) * 1000000000LL + until->tv_nsec - now.tv_nsec;
        clock_gettime(CLOCK_REALTIME, &end);
        const long long at = end.tv_nsec + (left > 0 ? left : 0);
        end.tv_sec += static_cast<time_t>(at / 1000000000LL);
        end.tv_nsec = static_cast<long>(at % 1000000000LL);
    }
    return pthread_cond_timedwait(condition, mutex, &end);
}

#ifdef DLFO_STRUCT_HAS_EH_DBASE
namespace {
struct Search {
    ElfW(Addr) address;
    dl_find_object* found;
};

int look_into(dl_phdr_info* object, size_t, void* data) {
    const auto& search = *static_cast<Search*>(data);
    const ElfW(Phdr)* frames = nullptr;
    const ElfW(Phdr)* dynamic = nullptr;
    bool inside = false;
    ElfW(Addr) first = UINTPTR_MAX;
    ElfW(Addr) last = 0;
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const ElfW(Phdr)& part = object->dlpi_phdr[i];
        const ElfW(Addr) start = object->dlpi_addr + part.p_vaddr;
        if (part.p_type == PT_LOAD) {
            inside = inside || (search.address >= start && search.address - start < part.p_memsz);
            first = start < first ? start : first;
            last = start + part.p_memsz > last ? start + part.p_memsz : last;
        }
        if (part.p_type == PT_GNU_EH_FRAME) frames = &part;
        if (part.p_type == PT_DYNAMIC) dynamic = &part;
    }
    if (!inside) return 0;
    if (!frames) return -1;
    memset(search.found, 0, sizeof *search.found);
    search.found->dlfo_map_start = reinterpret_cast<void*>(first);
    search.found->dlfo_map_end = reinterpret_cast<void*>(last);
    search.found->dlfo_eh_frame = reinterpret_cast<void*>(object->dlpi_addr + frames->p_vaddr);
#if DLFO_STRUCT_HAS_EH_DBASE
    if (dynamic)
        for (auto* entry = reinterpret_cast<const ElfW(Dyn)*>(object->dlpi_addr + dynamic->p_vaddr);
             entry->d_tag != DT_NULL; ++entry)
            if (entry->d_tag == DT_PLTGOT)
                search.found->dlfo_eh_dbase = reinterpret_cast<void*>(entry->d_un.d_ptr);
#else
    (void)dynamic;
#endif
    return 1;
}
} // namespace

// glibc 2.35. GCC's unwinder asks nothing else where it was built with a newer one.
int _dl_find_object(void* address, dl_find_object* result) noexcept {
    Search search{reinterpret_cast<ElfW(Addr)>(address), result};
    return dl_iterate_phdr(look_into, &search) == 1 ? 0 : -1;
}
#endif

} // extern "C"
