// Texts of report/replay/, embedded when the library is built (report/cmake/EmbedReplay.cmake).
#pragma once

#include <string_view>

namespace spf {

extern const std::string_view kReplayHtml;    ///< page with the marks @TITLE@ @STYLE@ @DATA@ @SCRIPT@
extern const std::string_view kReplayStyle;   ///< all *.css in order of their names
extern const std::string_view kReplayScript;  ///< all *.js in order of their names

}  // namespace spf
