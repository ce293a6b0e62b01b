# has: gcc libc6-dev pkg-config
apt-get -q install -y --no-install-recommends \
  /packages/libtrc0_*.deb /packages/libtrc-dev_*.deb
cp /trc/client/examples/c/compensate.c .
# shellcheck disable=SC2046
cc -std=c99 compensate.c $(pkg-config --cflags --libs trc) -o compensate
./compensate part.nc tool_radius=5 >part_g40.nc
