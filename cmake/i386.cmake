# Toolchain for the 32-bit library (Debian: g++-multilib, lib32z1-dev). Floats go through the x87, as in old programs: their stacks, and those of
# Windows programs, are aligned to 4 bytes, on which code for SSE falls over.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR i686)
set(CMAKE_C_COMPILER gcc)
set(CMAKE_CXX_COMPILER g++)
set(CMAKE_ASM_COMPILER gcc)
set(CMAKE_C_FLAGS_INIT "-m32 -D_FILE_OFFSET_BITS=64")
set(CMAKE_CXX_FLAGS_INIT "-m32 -D_FILE_OFFSET_BITS=64")
set(CMAKE_ASM_FLAGS_INIT -m32)
set(CMAKE_LIBRARY_ARCHITECTURE i386-linux-gnu)
set(GLCAST_ZLIB_STATIC /usr/lib32/libz.a CACHE FILEPATH "")
