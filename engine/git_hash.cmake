# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Run at every build: writes OUTPUT with the commit of SOURCE, and leaves it alone if nothing changed.
set(hash "unknown")
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE described RESULT_VARIABLE code ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(code EQUAL 0 AND described)
    set(hash "${described}")
endif()
set(text "#define ASPERITY_GIT_HASH \"${hash}\"\n")
set(old "")
if(EXISTS ${OUTPUT})
    file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
    file(WRITE ${OUTPUT} "${text}")
endif()
