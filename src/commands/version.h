// Which clothsim this is.
#pragma once

namespace clothsim {

// "1.2.3 (commit 0123456)"; a + behind the commit where files were changed since, no commit where none is
// known.
[[nodiscard]] const char* versionText();

}  // namespace clothsim
