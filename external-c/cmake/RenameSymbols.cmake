# Merges ARCHIVES (a list with commas) into OUTPUT, with "cmb." before the name of every symbol that they define but those
# of KEEP. A script for cmake -P.
string(REPLACE "," ";" archives "${ARCHIVES}")
string(REPLACE "," ";" keep "${KEEP}")
get_filename_component(folder "${OUTPUT}" DIRECTORY)
set(merged "${folder}/merged.a")
set(commands "create ${merged}\n")
foreach(archive IN LISTS archives)
  string(APPEND commands "addlib ${archive}\n")
endforeach()
file(WRITE "${folder}/merge.mri" "${commands}save\nend\n")
execute_process(COMMAND ${AR} -M INPUT_FILE "${folder}/merge.mri" COMMAND_ERROR_IS_FATAL ANY)

execute_process(COMMAND ${NM} --defined-only --extern-only --format=posix "${merged}" OUTPUT_VARIABLE listed ERROR_QUIET
                COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+ [A-Za-z] [^\n]*" lines "${listed}")
list(TRANSFORM lines REPLACE " .*" "")
list(REMOVE_DUPLICATES lines)
list(SORT lines)
list(REMOVE_ITEM lines ${keep})
list(TRANSFORM lines REPLACE "(.+)" "\\1 cmb.\\1")
list(JOIN lines "\n" map)
file(WRITE "${folder}/renamed.txt" "${map}\n")
file(REMOVE "${OUTPUT}")
execute_process(COMMAND ${OBJCOPY} --enable-deterministic-archives --strip-debug
                        "--redefine-syms=${folder}/renamed.txt" "${merged}" "${OUTPUT}" COMMAND_ERROR_IS_FATAL ANY)
