# has: nodejs npm
apt-get -q install -y --no-install-recommends /packages/trcd_*.deb
export npm_config_cafile=/certificates.pem
(cd /trc/client/node && npm pack)
npm install /trc/client/node/trc-client-*.tgz
cat >first.mjs <<'JS'
import { readFileSync } from "node:fs";
import { compensate } from "trc-client";

const { text } = await compensate(readFileSync("part.nc"), { radius: 5 });
process.stdout.write(text);
JS
node first.mjs >part_g40.nc
