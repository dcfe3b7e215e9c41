#!/usr/bin/env bash
# Makes the Debian packages, checks them with lintian, and installs and runs them in a root that has nothing else:
# try_packages.sh [FOLDER], a folder of its own to work in. Needs root, debootstrap and lintian, and a network. The root is
# made of the packages of DEBOOTSTRAP_MIRROR, an address, if that is set, else of debootstrap's own.
set -euo pipefail
source_dir=$(cd "$(dirname "$0")/.." && pwd)
folder=${1:-$source_dir/build-packages}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
cmake -S "$source_dir" -B "$folder/build" -D CMAKE_BUILD_TYPE=Release -D CMAKE_INSTALL_PREFIX=/usr \
  -D CRUDE_REGISTRATION_WITH_TESTS=OFF -D CRUDE_REGISTRATION_WITH_EXAMPLES=OFF -D CRUDE_REGISTRATION_WITH_BENCHMARKS=OFF \
  -D CRUDE_REGISTRATION_WITH_PYTHON=OFF -D CRUDE_REGISTRATION_WITH_DOC=OFF
cmake --build "$folder/build" -j "${CRUDE_REGISTRATION_JOBS:-2}"
rm -rf "$folder/build/packages"
(cd "$folder/build" && cpack -G DEB)

# The address of the maintainer is for those who hand the packages on.
lintian --fail-on error,warning --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog \
  "$folder"/build/packages/*.deb

root=$folder/root
[ -e "$root/etc/debian_version" ] || debootstrap --variant=minbase bookworm "$root" ${DEBOOTSTRAP_MIRROR:+"$DEBOOTSTRAP_MIRROR"}
cp "$folder"/build/packages/*.deb "$root/tmp/"
chroot "$root" sh -euc '
  export DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin:/sbin:/bin
  apt-get -q update
  apt-get -q install -y --no-install-recommends /tmp/crude-register_*.deb
  crude_register --version
  cd /tmp
  crude_register simulate --output scans --samples 150
  crude_register register scans/scan_0.ply scans/scan_1.ply --apply moved.ply
  test -s moved.ply
  ! command -v crude_register_mpi
  ! command -v mpirun
  if [ -e "$(echo /tmp/crude-register-mpi_*.deb)" ]; then
    apt-get -q install -y --no-install-recommends /tmp/crude-register-mpi_*.deb
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
      mpirun -n 2 --oversubscribe crude_register_mpi assemble scans --poses poses.txt
    test -s poses.txt
  fi
  apt-get -q install -y --no-install-recommends /tmp/libcrude-registration-dev_*.deb cmake make g++'
rm -rf "$root/tmp/consumer"
cp -r "$source_dir/test/consumer" "$root/tmp/consumer"
chroot "$root" sh -euc '
  export PATH=/usr/sbin:/usr/bin:/sbin:/bin
  cmake -S /tmp/consumer -B /tmp/consumer/build -D LIBRARY=CGAL::Crude_registration_compiled \
    -D EXPECTED_INCLUDE_DIR=/usr/include
  cmake --build /tmp/consumer/build
  /tmp/consumer/build/consumer /tmp/motion.txt
  apt-get -q purge -y "crude-register*" libcrude-registration-dev
  ! command -v crude_register
  test ! -e /usr/include/CGAL/Crude_registration'
echo "the packages are installed, used and taken away"
