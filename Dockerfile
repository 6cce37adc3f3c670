# The artifact on a fresh Debian 12:  docker build -t capsule . && docker run --rm capsule make test
FROM debian:12
RUN apt-get update && apt-get install -y --no-install-recommends git make
WORKDIR /capsule
COPY . .
RUN make setup && make build
CMD ["make", "figures"]
