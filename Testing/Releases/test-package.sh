#!/usr/bin/env bash
# Makes the Debian package in a bare root of a release, from the tarball of the sources and without a network, and installs it in
# another bare root, where ParaView's window, pvpython and the system's Python use it.
#
#   Testing/Releases/test-package.sh RELEASE
#
# The package and the tarball stay in build/roots/RELEASE.products.
set -euo pipefail
cd "$(dirname "$0")/../.."
release=${1:?release}
root=build/roots/$release
products=$root.products

Testing/Releases/in-root.sh "$release" root bash -euxc '
  .ci/install-packages
  apt-get install --yes --quiet=2 --no-install-recommends dpkg-dev file
  cmake --preset default > configure.log
  cpack --config build/default/CPackSourceConfig.cmake -B build/products
  mkdir -p /from-tarball
  tar --extract --file build/products/directionalmultigrid-*.tar.gz --directory /from-tarball --strip-components 1
  cd /from-tarball
  # README, without a network
  unshare --net bash -euxc "
    cmake --preset default -DCMAKE_INSTALL_PREFIX=/usr > configure.log
    cmake --build --preset default
    cpack --config build/default/CPackConfig.cmake -B /tree/build/products"
'
mkdir -p "$products"
rm -f "$products"/*
mv "$root"/tree/build/products/*.{deb,tar.gz} "$products"

Testing/Releases/in-root.sh "$release" root true
cp "$products"/*.deb "$root"
Testing/Releases/in-root.sh --again "$release" root bash -euxc '
  apt-get update --quiet=2
  DEBIAN_FRONTEND=noninteractive apt-get install --yes --quiet --no-install-recommends /*.deb xauth xvfb
  cmp LICENSE /usr/share/doc/directionalmultigrid/copyright
  pvpython Testing/Releases/use_plugin.py
  /usr/bin/python3 Testing/Releases/use_module.py
  xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
    timeout 120 paraview --script=Testing/Releases/use_plugin.py | tee window.log
  grep --line-regexp "8 singular points" window.log
  apt-get install --yes --quiet=2 --reinstall paraview
  pvpython Testing/Releases/use_plugin.py
  apt-get remove --yes --quiet=2 directionalmultigrid
  if grep directionalmultigrid /usr/lib/*/paraview-*/paraview.conf; then
    exit 1 # a line that nothing stands behind
  fi
'
