# Manual pages and bash completion, made of the commands' own --help.
set(manuals_folder ${PROJECT_BINARY_DIR}/manuals)
add_custom_command(
    OUTPUT ${manuals_folder}/made
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/gen_manuals.py ${manuals_folder} ${PROJECT_VERSION}
            $<TARGET_FILE:glcast> $<TARGET_FILE:glcast-run>
    COMMAND gzip -9nkf ${manuals_folder}/*.1
    COMMAND ${CMAKE_COMMAND} -E touch ${manuals_folder}/made
    DEPENDS gen_manuals.py glcast glcast-run
    COMMENT "Manual pages and completion")
add_custom_target(manuals ALL DEPENDS ${manuals_folder}/made)
install(DIRECTORY ${manuals_folder}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime FILES_MATCHING PATTERN "*.1.gz")
foreach(command IN ITEMS glcast glcast-run)
    install(FILES ${manuals_folder}/${command}.bash DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions
        RENAME ${command} COMPONENT runtime)
endforeach()
