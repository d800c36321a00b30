# find_package(glcast): glcast::reconstruct (captured images to mesh), glcast::mesh (checks), glcast::view (box, views, images).
include(CMakeFindDependencyMacro)
find_dependency(glm)
find_dependency(TBB)
include(${CMAKE_CURRENT_LIST_DIR}/glcast-targets.cmake)
