# Writes OUTPUT, the source file with the version and the commit that is built: `cmake -DVERSION=... -DSOURCE=... -DOUTPUT=... -P`.
# It is written anew only when it changes. In an archive made by `git archive` the commit stands in cmake/commit.txt; in a
# checkout git knows it, and a + says that files were changed since.
file(STRINGS ${SOURCE}/cmake/commit.txt commit LIMIT_COUNT 1)
if(commit MATCHES "Format")
  set(commit "")
  find_program(GIT git)
  if(GIT AND EXISTS ${SOURCE}/.git)
    execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --exclude * --dirty=+ OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
endif()
set(TEXT "${VERSION}")
if(commit)
  string(APPEND TEXT " (commit ${commit})")
endif()
configure_file(${SOURCE}/cmake/version.cpp.in ${OUTPUT} @ONLY)
