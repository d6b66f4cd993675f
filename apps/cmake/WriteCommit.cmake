# cmake -D OUTPUT=... -D SOURCE_DIR=... -D GIT=... -P WriteCommit.cmake
# Writes a C++ file with the commit of the sources, "unknown" outside a checkout; leaves it alone when nothing changed.
set(commit unknown)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 --match=
    OUTPUT_VARIABLE described RESULT_VARIABLE status OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(status EQUAL 0)
    set(commit ${described})
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
namespace spf {
extern const char* const kCommit;
const char* const kCommit = "@commit@";
}  // namespace spf
]] @ONLY)
