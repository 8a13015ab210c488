//! Keyset paging: every item once, newest first; a token is valid only for its own list.

use super::clients::{Grpc, Http};
use super::server::Server;
use super::work::world;
use cgda::grpc::proto;
use tonic::Code;

#[tokio::test]
async fn pages_hold_every_item_once_over_both_protocols() {
    let server = Server::start();
    let http = Http::new(&server);
    let mut ids = Vec::new();
    for _ in 0..5 {
        ids.push(http.post("/worlds", &world()).await.expect(201).text("/id").to_owned());
    }
    ids.reverse();
    let (mut found, mut token, mut pages) = (Vec::new(), String::new(), 0);
    loop {
        let page = http.get(&format!("/worlds?page_size=2&page_token={token}")).await.expect(200);
        found.extend(page.json["items"].as_array().unwrap().iter().map(|item| item["id"].as_str().unwrap().to_owned()));
        pages += 1;
        token = page.text("/next_page_token").to_owned();
        if token.is_empty() {
            break;
        }
        if pages == 1 {
            http.get(&format!("/robots?page_token={token}")).await.expect_problem(400, "invalid_page_token");
            let mut grpc = Grpc::new(&server).await;
            let request = proto::ListWorldsRequest { page_size: 2, page_token: token.clone() };
            let second = grpc.worlds.list_worlds(request).await.unwrap().into_inner();
            assert_eq!(second.worlds.iter().map(|world| &world.id).collect::<Vec<_>>(), [&ids[2], &ids[3]]);
            let wrong = proto::ListWorldsRequest { page_size: 201, page_token: String::new() };
            assert_eq!(grpc.worlds.list_worlds(wrong).await.unwrap_err().code(), Code::InvalidArgument);
        }
    }
    assert_eq!((found, pages), (ids, 3));
    http.get("/worlds?page_size=0").await.expect_problem(400, "invalid_page_size");
    http.get("/worlds?page_size=201").await.expect_problem(400, "invalid_page_size");
}
