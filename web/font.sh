#!/bin/sh
# Makes web/src/inter.woff2, the font of the pages: Inter 4.1 with the characters that their texts use, and weights from 400
# to 700; and web/src/first/inter.woff2 with the few characters of the first page. It downloads the npm package inter-ui and the Python package fonttools; builds use the committed file.
set -eu
home=$(dirname "$(dirname "$(readlink -f "$0")")")
temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT
cd "$temporary"
npm pack --silent inter-ui@4.1.1 >/dev/null
tar xf inter-ui-4.1.1.tgz
python3 -m venv tools
tools/bin/pip install --quiet fonttools==4.68.0 brotli==1.2.1
# English, German, Greek symbols, and signs. Optical sizes above 14 would double the file.
characters='U+20-7E,U+A0,U+B0-B3,U+B5,U+B7,U+D7,U+C4,U+D6,U+DC,U+DF,U+E4,U+F6,U+FC,U+3A9,U+3B1,U+3B3,U+3B8,U+3BC,U+3C9,U+3D6'
signs='U+2013,U+2014,U+2018-201A,U+201C-201E,U+2026,U+2190-2193,U+21BA,U+21BB,U+2212,U+2248,U+2264,U+2265'
tools/bin/fonttools varLib.instancer -q -o inter.ttf package/variable/InterVariable.woff2 opsz=14 wght=400:700
tools/bin/pyftsubset inter.ttf --unicodes="$characters,$signs" --layout-features=kern,tnum --no-hinting --flavor=woff2 \
    --output-file="$home/web/src/inter.woff2"
few='U+20-22,U+26-29,U+2B-3A,U+3F,U+41-5A,U+61-7A,U+C4,U+D6,U+DC,U+DF,U+E4,U+F6,U+FC,U+2013,U+2026,U+2212'
tools/bin/pyftsubset "$home/web/src/inter.woff2" --unicodes="$few" --layout-features=kern,tnum --no-hinting --flavor=woff2 \
    --output-file="$home/web/src/first/inter.woff2"
