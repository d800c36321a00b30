// What the .3mf reader and writer share: lib3mf's objects, given back at the end. Internal.
#pragma once
#include <Model/COM/NMR_DLLInterfaces.h>

#include <stdexcept>

namespace glcast::format {

struct ThreeMfHandle {
    NMR::PLib3MFBase* of = nullptr;

    ThreeMfHandle() = default;
    ThreeMfHandle(const ThreeMfHandle&) = delete;
    ThreeMfHandle& operator=(const ThreeMfHandle&) = delete;
    ~ThreeMfHandle() {
        if (of) NMR::lib3mf_release(of);
    }
};

inline void require(LIB3MFRESULT result, const char* otherwise) {
    if (result != 0) throw std::runtime_error(otherwise);
}

} // namespace glcast::format
