#!/bin/sh
# Builds Cairo without X11, for the wheels.
#
#   build_cairo.sh PREFIX        installs it into PREFIX
#
# A wheel with the Cairo of a distribution needs libX11 and libXrender. auditwheel does not put these into the
# wheel, because it expects them on every Linux. Containers and servers often have no X11.
# Needs meson, curl, and the headers of pixman, freetype, fontconfig and libpng.
# SWIRL_CAIRO_URL is another address of the same file.
set -eu
prefix=$1
version=1.18.4
sha256=445ed8208a6e4823de1226a74ca319d3600e83f6369f99b14265006599c32ccb
url=${SWIRL_CAIRO_URL-https://cairographics.org/releases/cairo-$version.tar.xz}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
curl --fail --silent --show-error --location --output "$folder/cairo.tar.xz" "$url"
echo "$sha256  $folder/cairo.tar.xz" | sha256sum --check --quiet
tar -xf "$folder/cairo.tar.xz" -C "$folder"
meson setup "$folder/build" "$folder/cairo-$version" --prefix "$prefix" --libdir lib --buildtype release \
    -Dauto_features=disabled -Dfontconfig=enabled -Dfreetype=enabled -Dpng=enabled -Dzlib=enabled
meson install -C "$folder/build"
install -D -m 644 -t "$prefix/share/licenses/cairo" "$folder/cairo-$version"/COPYING*
