#include "shim/preload/elf_file.h"

#include <elf.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>

namespace glcast::preload {
namespace {

/// A file mapped for reading; every access is checked against its size.
class MappedFile {
  public:
    explicit MappedFile(const char* path) {
        const int file = open(path, O_RDONLY | O_CLOEXEC);
        if (file < 0) return;
        struct stat info;
        if (fstat(file, &info) == 0 && S_ISREG(info.st_mode) && info.st_size > 0) {
            void* bytes = mmap(nullptr, static_cast<size_t>(info.st_size), PROT_READ, MAP_PRIVATE, file, 0);
            if (bytes != MAP_FAILED)
                data = static_cast<const char*>(bytes), size = static_cast<size_t>(info.st_size);
        }
        close(file);
    }
    ~MappedFile() {
        if (data) munmap(const_cast<char*>(data), size);
    }
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    /// `count` things at an offset, or null where they reach past the end.
    template <class T> const T* at(size_t offset, size_t count = 1) const {
        if (offset > size || count > (size - offset) / sizeof(T) || offset % alignof(T)) return nullptr;
        return reinterpret_cast<const T*>(data + offset);
    }
    /// A string that ends within the file.
    const char* string(size_t offset) const {
        if (offset >= size || !std::memchr(data + offset, 0, size - offset)) return nullptr;
        return data + offset;
    }

  private:
    const char* data = nullptr;
    size_t size = 0;
};

struct Segments {
    const ElfW(Phdr) * headers = nullptr;
    size_t count = 0;

    const ElfW(Phdr) * dynamic() const {
        for (size_t i = 0; i < count; ++i)
            if (headers[i].p_type == PT_DYNAMIC) return &headers[i];
        return nullptr;
    }
    /// File offset of an address; 0 when no segment holds it.
    size_t offset(ElfW(Addr) address) const {
        for (size_t i = 0; i < count; ++i) {
            const ElfW(Phdr)& s = headers[i];
            if (s.p_type == PT_LOAD && address >= s.p_vaddr && address - s.p_vaddr < s.p_filesz)
                return s.p_offset + (address - s.p_vaddr);
        }
        return 0;
    }
};

Segments read_segments(const MappedFile& file) {
    const auto* header = file.at<ElfW(Ehdr)>(0);
    if (!header || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0) return {};
    if (header->e_ident[EI_CLASS] != (sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32)) return {};
    if (header->e_phentsize != sizeof(ElfW(Phdr))) return {};
    const auto* headers = file.at<ElfW(Phdr)>(header->e_phoff, header->e_phnum);
    return headers ? Segments{headers, header->e_phnum} : Segments{};
}

} // namespace

bool any_needed_library(const char* path, bool (*matches)(const char* library)) {
    const MappedFile file(path);
    const Segments segments = read_segments(file);
    const ElfW(Phdr)* dynamic = segments.dynamic();
    if (!dynamic) return false;
    const size_t count = dynamic->p_filesz / sizeof(ElfW(Dyn));
    const auto* entries = file.at<ElfW(Dyn)>(dynamic->p_offset, count);
    if (!entries) return false;
    size_t strings = 0;
    for (size_t i = 0; i < count; ++i)
        if (entries[i].d_tag == DT_STRTAB) strings = segments.offset(entries[i].d_un.d_ptr);
    for (size_t i = 0; strings && i < count; ++i) {
        if (entries[i].d_tag != DT_NEEDED) continue;
        const char* library = file.string(strings + entries[i].d_un.d_val);
        if (library && matches(library)) return true;
    }
    return false;
}

} // namespace glcast::preload
