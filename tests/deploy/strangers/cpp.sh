# has: cmake g++ make
apt-get -q install -y --no-install-recommends libeigen3-dev \
  libgrpc++-dev libprotobuf-dev protobuf-compiler-grpc /packages/trcd_*.deb
cp -r /trc/client/examples/cpp .
cmake -S cpp -B build -DCMAKE_PREFIX_PATH=/packages/client
cmake --build build
trcd &
until trc health --server 127.0.0.1:50051; do sleep 0.2; done
# The program says its radius itself.
sed -i '2i V.G.WZ_AKT.R=5' part.nc
build/compensate 127.0.0.1:50051 part.nc >part_g40.nc
