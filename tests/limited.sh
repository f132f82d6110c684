#!/bin/sh
# limited.sh SECONDS COMMAND...: runs a test, of which no process may use more than this processor time. A limit
# by the clock would depend on the other work of the machine; ctest has one of an hour, for tests that wait for ever.
# If $SWIRL_TEST_TIMES is a folder, files there get the commands and their processor time (`times` of the shell).
seconds=$1
shift
# The first limit sends a signal that names the reason, the second one kills.
ulimit -S -t "$seconds" && ulimit -H -t $((seconds + 10)) || exit 1
# A shell starts its background jobs with Ctrl-C ignored, and programs inherit that. Tests send it.
if env --default-signal=INT,QUIT true 2>/dev/null; then
    env --default-signal=INT,QUIT "$@"
else
    "$@"
fi
code=$?
[ -z "${SWIRL_TEST_TIMES-}" ] || { echo "$*" && times; } >>"$SWIRL_TEST_TIMES/$$"
if [ $code -gt 128 ] && [ "$(kill -l $code)" = XCPU ]; then
    echo "limited.sh: the test used more than $seconds seconds of processor time"
fi
exit $code
