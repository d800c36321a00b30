// Tells AddressSanitizer and ThreadSanitizer that a thread goes to another stack and comes back; nothing in
// other builds.
#pragma once
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#endif
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace glcast::preload {

class StackSwitch {
  public:
#if defined(__SANITIZE_ADDRESS__)
    void leave_for(const void* stack, std::size_t size) {
        __sanitizer_start_switch_fiber(&fake_stack, stack, size);
    }
    void arrived() { __sanitizer_finish_switch_fiber(nullptr, &program_stack, &program_size); }
    void leave_for_good() { __sanitizer_start_switch_fiber(nullptr, program_stack, program_size); }
    void came_back() { __sanitizer_finish_switch_fiber(fake_stack, nullptr, nullptr); }

  private:
    void* fake_stack = nullptr;
    const void* program_stack = nullptr;
    std::size_t program_size = 0;
#elif defined(__SANITIZE_THREAD__)
    void leave_for(const void*, std::size_t) {
        program = __tsan_get_current_fiber();
        ours = __tsan_create_fiber(0);
        __tsan_switch_to_fiber(ours, 0);
    }
    void arrived() {}
    void leave_for_good() { __tsan_switch_to_fiber(program, 0); }
    void came_back() { __tsan_destroy_fiber(ours); }

  private:
    void *program = nullptr, *ours = nullptr;
#else
    void leave_for(const void*, std::size_t) {}
    void arrived() {}
    void leave_for_good() {}
    void came_back() {}
#endif
};

} // namespace glcast::preload
