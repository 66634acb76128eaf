#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes FOLDER/python, CPython 3.13 for musl with the loader of musl, because there is none to install here: from the
# sources and the package of Debian, by the compiler of ziglang. About two minutes of two processors.
# Usage: musl_python.sh FOLDER ZIG
set -euo pipefail
mkdir -p "$1"
cd "$1"
folder=$PWD zig=$2 repository=$(cd "${BASH_SOURCE[0]%/*}/../.." && pwd)
[[ ! -x python ]] || exit 0

mkdir -p lists
mirror=$("$repository/tools/find_mirror")
printf '%s\n' "deb $mirror trixie main" "deb-src $mirror trixie main" "deb-src $mirror bookworm main" >sources.list
apt=(apt-get --quiet=2 -o "Dir::Etc::SourceList=$folder/sources.list" -o Dir::Etc::SourceParts=/dev/null
  -o "Dir::State::Lists=$folder/lists" -o APT::Sandbox::User=root)
"${apt[@]}" update
"${apt[@]}" download musl
"${apt[@]}" --download-only source python3.13 zlib/bookworm >/dev/null
dpkg-deb --extract musl_*.deb musl
mkdir -p source zlib
tar --extract --strip-components=1 --directory=source --file="$(echo python3.13_*.orig.tar.*z)"
tar --extract --strip-components=1 --directory=zlib --file="$(echo zlib_*.orig.tar.*)"

cc="$zig cc -target x86_64-linux-musl -mcpu=x86_64 -dynamic -Wno-date-time"
cc+=" -Wl,-dynamic-linker,$folder/musl/usr/lib/x86_64-linux-musl/libc.so"
(cd zlib && $cc -w -O1 -fPIC -DHAVE_UNISTD_H -c ./*.c && $zig ar rcs libz.a ./*.o)

cd source
./configure --quiet --disable-test-modules --without-ensurepip --disable-ipv6 --with-pkg-config=no \
  CC="$cc" AR="$zig ar" RANLIB="$zig ranlib" ZLIB_CFLAGS="-I$folder/zlib" ZLIB_LIBS="$folder/zlib/libz.a" >../log.txt 2>&1
# configure does not recognize the system, and so not the names of its modules.
system=cpython-313-x86_64-linux-musl
make --silent --jobs="$(nproc)" OPT="-O1 -DNDEBUG" SOABI=$system EXT_SUFFIX=.$system.so >>../log.txt 2>&1
ln -s "$PWD/python" ../python
