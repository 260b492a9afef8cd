# The command `starl` with its page. Build and run:
#
#     docker build -t starl .
#     docker run --rm starl run race
#     docker run --rm -v "$PWD:/work" starl test program.starl --seeds 50
FROM rust:1.95-slim-trixie AS build
RUN apt-get update \
    && apt-get install -qy --no-install-recommends binaryen gcc libc6-dev make nodejs npm \
    && rm -rf /var/lib/apt/lists/*
RUN rustup target add wasm32-unknown-unknown
WORKDIR /starl
COPY . .
# Paths of the build machine stay out of the command.
ENV RUSTFLAGS="--remap-path-prefix=/starl=starl --remap-path-prefix=/usr/local/cargo=cargo"
RUN make wasm-module && cd playground && npm ci --no-audit --no-fund && npm run --silent build
RUN cargo build --locked --release -p starl

FROM debian:trixie-slim
COPY --from=build /starl/target/release/starl /usr/local/bin/starl
COPY LICENSE-APACHE LICENSE-MIT THIRD-PARTY.md /usr/share/doc/starl/
COPY licences /usr/share/doc/starl/licences
RUN useradd --create-home starl
USER starl
WORKDIR /work
ENTRYPOINT ["starl"]
CMD ["--help"]
