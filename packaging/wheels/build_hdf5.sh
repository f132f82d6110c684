#!/bin/sh
# Builds HDF5 as a static library without network access, for the wheels.
#
#   build_hdf5.sh PREFIX        installs it into PREFIX
#
# Debian's HDF5 can read files from Amazon S3. A wheel with it needs libcurl, and so 40 libraries for TLS,
# LDAP and Kerberos. The source is that of Debian 12.
# Needs a C compiler, make, curl and the headers of zlib. SWIRL_HDF5_URL is another address of the same file.
set -eu
prefix=$1
version=1.10.8+repack1
sha256=7b38e58ff83b13fd8959a90b13bf896bc318ba096c940ab0847abf3ad41a0b31
url=${SWIRL_HDF5_URL-https://deb.debian.org/debian/pool/main/h/hdf5/hdf5_$version.orig.tar.gz}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
curl --fail --silent --show-error --location --output "$folder/hdf5.tar.gz" "$url"
echo "$sha256  $folder/hdf5.tar.gz" | sha256sum --check --quiet
tar -xf "$folder/hdf5.tar.gz" -C "$folder"
cd "$folder/hdf5-$version"
./configure --prefix="$prefix" --libdir="$prefix/lib" --enable-build-mode=production --disable-shared --with-pic \
    --disable-tests --disable-tools --disable-fortran --disable-cxx --disable-java --with-zlib --without-szlib \
    --disable-ros3-vfd --without-libhdfs
make -j "$(nproc)" install
install -D -m 644 -t "$prefix/share/licenses/hdf5" COPYING*
