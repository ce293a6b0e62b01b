# has: python3
apt-get -q install -y --no-install-recommends /packages/python3-trc_*.deb /packages/trcd_*.deb
python3 -c 'import trc
print(trc.compensate(open("part.nc").read(), radius=5).text, end="")' >part_g40.nc
