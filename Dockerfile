# docker build -t facet . && docker run --rm -v "$PWD:/scenes" -w /scenes facet render scene.xml
FROM debian:12 AS build
RUN apt-get update && apt-get install -y --no-install-recommends git ca-certificates
COPY . /facet
RUN sh /facet/cmake/bootstrap.sh packages

FROM debian:12-slim
COPY --from=build /facet/build/packages/facet_*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/facet_*.deb && rm -rf /var/lib/apt/lists/*
ENTRYPOINT ["facet"]
